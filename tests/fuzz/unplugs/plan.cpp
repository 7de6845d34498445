// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/unplugs/plan.hpp"

#include <fmt/format.h>

#include <array>
#include <random>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz::unplugs {
namespace {

using std::chrono::microseconds;

constexpr std::array<const char*, kDeviceKinds> kDeviceNames{"Falcon", "Polhem", "serial board",
                                                             "event device", "HID device"};
constexpr std::array<const char*, kFaultKinds> kFaultNames{
    "unplug",        "loose plug",     "bounce",
    "other device",  "opening denied", "end of the program",
    "freeze",        "silent servo",   "reset of the port",
    "errors",        "stall",          "cut",
    "hang",          "mute",           "damage",
    "loss",          "bunches",        "restart",
    "busy",          "slow calls",     "refusal",
    "dropped events"};

using enum FaultKind;
constexpr std::array kUsb{unplug, loose, bounce, other_device, end_program, reset_port,  errors,
                          stall,  cut,   hang,   mute,         damage,      silent_servo};
constexpr std::array kSerial{unplug,      loose,  bounce,  other_device, denied,
                             end_program, freeze, errors,  hang,         mute,
                             damage,      loss,   bunches, restart,      silent_servo};
constexpr std::array kEvent{unplug, loose, bounce, other_device, denied, end_program, freeze,
                            errors, busy,  slow,   refusal,      drop,   silent_servo};
constexpr std::array kHid{unplug, loose,  bounce, other_device, denied,      end_program,
                          freeze, errors, slow,   refusal,      silent_servo};

constexpr std::array<const char*, kPhases> kPhaseNames{"at once", "opening", "setting up", "homing",
                                                       "running"};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(static_cast<std::uint32_t>(seed ^ seed >> 32)) {}

  [[nodiscard]] unsigned below(unsigned end) { return static_cast<unsigned>(random_() % end); }
  [[nodiscard]] bool happens(unsigned percent) { return below(100) < percent; }
  [[nodiscard]] nanoseconds between(unsigned from_us, unsigned to_us) {
    return microseconds(from_us + below(to_us - from_us));
  }
  /// Index of the percentage that is drawn; the remainder is the last index.
  template <std::size_t n>
  [[nodiscard]] std::size_t part(const std::array<unsigned, n>& percents) {
    unsigned drawn = below(100);
    for (std::size_t i = 0; i < n; ++i) {
      if (drawn < percents[i]) return i;
      drawn -= percents[i];
    }
    return n;
  }

 private:
  std::mt19937 random_;
};

// Half of them are plain unplugs.
FaultKind kind_of(DeviceKind device, Draw& draw) {
  const std::span<const FaultKind> kinds = faults_of(device);
  if (draw.happens(50)) return kinds[0];
  return kinds[1 + draw.below(static_cast<unsigned>(kinds.size()) - 1)];
}

nanoseconds after_of(Phase phase, Draw& draw) {
  if (phase == Phase::setting_up || phase == Phase::homing) return draw.between(0, 30'000);
  if (phase != Phase::running) return {};
  const std::size_t part = draw.part(std::array{25U, 50U});
  if (part == 0) return draw.between(0, 10'000);
  return part == 1 ? draw.between(10'000, 80'000) : draw.between(80'000, 250'000);
}

// Before it is noticed, before the next search, and later.
nanoseconds lasts_of(Draw& draw) {
  switch (draw.part(std::array{30U, 55U, 12U})) {
    case 0:
      return draw.between(0, 2'000);
    case 1:
      return draw.between(2'000, 220'000);
    case 2:
      return draw.between(220'000, 600'000);
    default:
      return draw.between(600'000, 3'000'000);
  }
}

Fault fault_of(DeviceKind device, Draw& draw) {
  Fault fault;
  fault.kind = kind_of(device, draw);
  constexpr std::array kPhaseParts{8U, 14U, 12U, 6U};
  fault.phase = static_cast<Phase>(draw.part(kPhaseParts));
  if (renders_springs(device) && fault.phase == Phase::homing) fault.phase = Phase::setting_up;
  fault.call = draw.below(60);
  fault.after = after_of(fault.phase, draw);
  if (renders_springs(device) && fault.phase == Phase::running && draw.happens(60))
    fault.after += draw.between(100'000, 200'000);
  fault.lasts = lasts_of(draw);
  fault.loses_power = draw.happens(10);
  fault.stays = draw.happens(30);
  fault.number = 1 + draw.below(fault.kind == FaultKind::loose ? 250 : 8);
  fault.depth = 1e-3 * (2 + draw.below(14));
  return fault;
}

double milliseconds_of(nanoseconds time) { return 1e3 * pdu::to_seconds(time); }

}  // namespace

std::span<const FaultKind> faults_of(DeviceKind kind) noexcept {
  if (kind == DeviceKind::serial_board) return kSerial;
  if (kind == DeviceKind::event_device) return kEvent;
  if (kind == DeviceKind::hid_device) return kHid;
  return kUsb;
}

Plan plan_of(std::uint64_t seed) {
  Draw draw(seed);
  Plan plan;
  plan.seed = seed;
  plan.device = static_cast<DeviceKind>(draw.below(kDeviceKinds));
  plan.line.out_at = 0.05 * draw.below(20);
  plan.line.in_at = 0.05 * draw.below(20);
  const bool is_of_octets =
      plan.device == DeviceKind::falcon || plan.device == DeviceKind::serial_board;
  plan.line.splits = is_of_octets && draw.happens(20);
  for (std::size_t i = 0; i < kFaults; ++i) plan.faults.push_back(fault_of(plan.device, draw));
  return plan;
}

Plan calmed(Plan plan) {
  plan.line = {};
  return plan;
}

std::string text_of(const Plan& plan) {
  return fmt::format("{}, {} faults, takes transfers at {:.2f} ms, sends at {:.2f} ms{}",
                     kDeviceNames[static_cast<std::size_t>(plan.device)], plan.faults.size(),
                     plan.line.out_at, plan.line.in_at, plan.line.splits ? ", in pieces" : "");
}

std::string text_of(const Fault& fault) {
  return fmt::format(
      "{}: {}, call {}, after {:.3f} ms, for {:.3f} ms, number {}, depth {:.0f} mm{}{}",
      kFaultNames[static_cast<std::size_t>(fault.kind)],
      kPhaseNames[static_cast<std::size_t>(fault.phase)], fault.call, milliseconds_of(fault.after),
      milliseconds_of(fault.lasts), fault.number, 1e3 * fault.depth,
      fault.loses_power ? ", without power" : "", fault.stays ? ", the hand stays" : "");
}

}  // namespace reckon::fuzz::unplugs

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/serial/serial_packets.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "reckon/haptics/devices/haptic_device.hpp"

namespace reckon::haptics {
namespace {

using Octets = std::span<const std::uint8_t>;

constexpr std::size_t kGreeting = 8;  // octets before the axes
constexpr std::size_t kAxis = 7;
constexpr std::size_t kReport = 13;                              // octets before the counts
constexpr std::int32_t kLongestStep = 1'000'000;                 // [nm]
constexpr std::uint16_t kLeastPeriod = 100, kMostPeriod = 2000;  // [us]

enum Flag : std::uint8_t { kHeldUntil = 1, kHoldsFrom = 2, kNotHomed = 4, kUnknown = 8 };

unsigned read16(Octets octets, std::size_t at) noexcept {
  return octets[at] | unsigned{octets[at + 1]} << 8;
}

std::uint32_t read32(Octets octets, std::size_t at) noexcept {
  return read16(octets, at) | std::uint32_t{read16(octets, at + 2)} << 16;
}

bool is_kind(Octets octets, SerialKind kind) noexcept {
  return !octets.empty() && octets[0] == static_cast<std::uint8_t>(kind);
}

void write16(std::span<std::uint8_t> octets, std::size_t at, std::uint16_t word) noexcept {
  octets[at] = static_cast<std::uint8_t>(word & 0xFF);
  octets[at + 1] = static_cast<std::uint8_t>(word >> 8);
}

std::string refusal_of_axes(const SerialGreeting& greeting) {
  std::array<bool, 3> taken{};
  for (std::size_t i = 0; i < greeting.axes; ++i) {
    const SerialAxis& axis = greeting.axis[i];
    if (axis.direction > 2 || taken[axis.direction])
      return "two of its axes have the same direction, or one has none: write 0, 1 or 2 for x, y "
             "or z";
    taken[axis.direction] = true;
    if (axis.nm_per_count == 0 || axis.nm_per_count > kLongestStep ||
        axis.nm_per_count < -kLongestStep)
      return "the step of one of its encoders is 0 or above 1 mm";
    if (axis.most_force == 0) return "one of its axes has no force";
  }
  return {};
}

std::string refusal_of_times(const SerialGreeting& greeting) {
  if (greeting.watchdog == 0 || greeting.watchdog > HapticDevice::kWatchdog.count())
    return "its watchdog drops the force after " + std::to_string(greeting.watchdog) +
           " ms: set it to 1 to 10 ms, because a force that is held longer adds energy";
  if (greeting.period < kLeastPeriod || greeting.period > kMostPeriod)
    return "its reports come every " + std::to_string(greeting.period) +
           " us: it must be 100 us to 2 ms";
  return {};
}

std::string in_units(double value, const char* unit) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "\"%.6g %s\"", value, unit);
  return text.data();
}

}  // namespace

std::optional<std::uint8_t> serial_version(Octets carried) noexcept {
  if (!is_kind(carried, SerialKind::greeting) || carried.size() < 2) return std::nullopt;
  return carried[1];
}

std::optional<SerialGreeting> serial_greeting(Octets carried) noexcept {
  if (serial_version(carried) != kSerialVersion || carried.size() < kGreeting) return std::nullopt;
  SerialGreeting greeting;
  greeting.answers = static_cast<std::uint16_t>(read16(carried, 2));
  greeting.axes = carried[4];
  greeting.watchdog = carried[5];
  greeting.period = static_cast<std::uint16_t>(read16(carried, 6));
  const std::size_t name = kGreeting + kAxis * greeting.axes;
  if (carried.size() <= name || carried.size() - name >= greeting.name.size()) return std::nullopt;
  for (std::size_t i = 0; i < std::min<std::size_t>(greeting.axes, kSerialAxes); ++i) {
    const Octets of_axis = carried.subspan(kGreeting + kAxis * i, kAxis);
    greeting.axis[i] = {of_axis[0], static_cast<std::int32_t>(read32(of_axis, 1)),
                        static_cast<std::uint16_t>(read16(of_axis, 5))};
  }
  for (std::size_t i = name; i < carried.size(); ++i) {
    if (carried[i] < 0x20 || carried[i] > 0x7E) return std::nullopt;
    greeting.name[i - name] = static_cast<char>(carried[i]);
  }
  return greeting;
}

std::optional<SerialReport> serial_report(Octets carried, std::size_t axes) noexcept {
  if (!is_kind(carried, SerialKind::report) || carried.size() != kReport + 4 * axes)
    return std::nullopt;
  const unsigned flags = carried[11];
  if ((flags & kUnknown) != 0) return std::nullopt;
  SerialReport report;
  report.sequence = static_cast<std::uint16_t>(read16(carried, 1));
  report.stamp = read32(carried, 3);
  if ((flags & kHeldUntil) != 0) report.until = static_cast<std::uint16_t>(read16(carried, 7));
  if ((flags & kHoldsFrom) != 0) report.from = static_cast<std::uint16_t>(read16(carried, 9));
  report.force_drops = static_cast<std::uint8_t>(flags >> 4);
  report.homed = (flags & kNotHomed) == 0;
  report.buttons = carried[12];
  for (std::size_t i = 0; i < axes; ++i)
    report.counts[i] = static_cast<std::int32_t>(read32(carried, kReport + 4 * i));
  return report;
}

SerialFrame ask_frame(std::uint16_t number) noexcept {
  std::array<std::uint8_t, 4> octets{static_cast<std::uint8_t>(SerialKind::ask), kSerialVersion};
  write16(octets, 2, number);
  return serial_frame(octets);
}

SerialFrame frame_of(const SerialForce& force, std::size_t axes) noexcept {
  assert(axes >= 1 && axes <= kSerialAxes);
  std::array<std::uint8_t, 3 + 2 * kSerialAxes> octets{
      static_cast<std::uint8_t>(SerialKind::force)};
  write16(octets, 1, force.number);
  for (std::size_t i = 0; i < axes; ++i)
    write16(octets, 3 + 2 * i, static_cast<std::uint16_t>(force.force[i]));
  return serial_frame(std::span(octets).first(3 + 2 * axes));
}

std::string refusal_of(const SerialGreeting& greeting, double max_force, double resolution) {
  if (greeting.axes == 0 || greeting.axes > kSerialAxes)
    return "it has " + std::to_string(greeting.axes) + " axes: it must have one to three";
  std::string refusal = refusal_of_axes(greeting);
  if (refusal.empty()) refusal = refusal_of_times(greeting);
  if (!refusal.empty()) return refusal;
  double force = 1e9, step = 0;
  for (std::size_t i = 0; i < greeting.axes; ++i) {
    force = std::min(force, 1e-3 * greeting.axis[i].most_force);
    step = std::max(step, 1e-9 * std::abs(1.0 * greeting.axis[i].nm_per_count));
  }
  // A millionth allows for rounding.
  if (force < max_force * (1 - 1e-6))
    return "its force is below max_force: write max_force = " + in_units(force, "N") +
           " in its [[device]]";
  if (step > resolution * (1 + 1e-6))
    return "its steps are longer than the assumed resolution: write resolution = " +
           in_units(1e6 * step, "um") + " in its [[device]]";
  return {};
}

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/event_facts.hpp"

#include <cerrno>
#include <cstddef>
#include <cstring>

namespace reckon::haptics {
namespace {

// A bitmap that an ioctl fills.
template <std::size_t most>
class Bits {
 public:
  Bits(EventCalls& calls, int file, unsigned long request) noexcept
      : answer_(calls.control(file, request, octets_.data())) {}

  [[nodiscard]] bool has(std::size_t bit) const noexcept {
    return answer_ >= 0 && (octets_[bit / 8] >> (bit % 8) & 1U) != 0;
  }

 private:
  std::array<std::uint8_t, most / 8 + 1> octets_{};
  int answer_;
};

constexpr std::size_t kOctetsOfAbs = ABS_MAX / 8 + 1, kOctetsOfKeys = KEY_MAX / 8 + 1,
                      kOctetsOfForces = FF_MAX / 8 + 1;

std::string name_of(EventCalls& calls, int file) {
  std::array<char, 128> name{};
  if (calls.control(file, EVIOCGNAME(sizeof name - 1), name.data()) < 0) return "a device";
  return name.data();
}

std::optional<input_absinfo> ask_axis(EventCalls& calls, int file, std::size_t axis) noexcept {
  input_absinfo info{};
  if (calls.control(file, EVIOCGABS(ABS_X + axis), &info) < 0) return std::nullopt;
  return info;
}

}  // namespace

std::optional<EventFacts> event_facts(EventCalls& calls, int file) {
  const Bits<FF_MAX> forces(calls, file, EVIOCGBIT(EV_FF, kOctetsOfForces));
  EventFacts facts;
  facts.has_springs = forces.has(FF_SPRING);
  facts.has_constant_forces = forces.has(FF_CONSTANT);
  facts.has_gain = forces.has(FF_GAIN);
  facts.has_autocenter = forces.has(FF_AUTOCENTER);
  bool gives_force = false;
  for (std::size_t bit = FF_EFFECT_MIN; bit <= FF_EFFECT_MAX; ++bit)
    gives_force = gives_force || forces.has(bit);
  if (!gives_force) return std::nullopt;
  facts.name = name_of(calls, file);
  facts.fault = calls.fault(file);
  const Bits<ABS_MAX> axes(calls, file, EVIOCGBIT(EV_ABS, kOctetsOfAbs));
  for (std::size_t axis = 0; axis < facts.axes.size(); ++axis) {
    if (!axes.has(ABS_X + axis)) continue;
    if (const auto info = ask_axis(calls, file, axis))
      facts.axes[axis] = EventAxis{info->minimum, info->maximum};
  }
  const Bits<KEY_MAX> keys(calls, file, EVIOCGBIT(EV_KEY, kOctetsOfKeys));
  for (std::uint16_t code = 0; code < KEY_MAX; ++code)
    if (keys.has(code)) facts.buttons.push_back(code);
  if (calls.control(file, EVIOCGEFFECTS, &facts.most_effects) < 0) facts.most_effects = 0;
  return facts;
}

std::string fault_of(const EventFacts& facts, int axes) {
  constexpr int kEffects = 2;
  if (!facts.has_springs) {
    return facts.has_constant_forces
               ? "it renders constant forces only, no springs (FF_SPRING): polling makes them too "
                 "late for a passive wall, so Reckon does not use it"
               : "it renders no springs (FF_SPRING), which walls need";
  }
  if (facts.most_effects < kEffects)
    return "it holds " + std::to_string(facts.most_effects) +
           " effects at once, and walls on both sides need two";
  if (!facts.fault.empty()) return facts.fault;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(axes); ++axis) {
    const char* const name = axis == 0 ? "ABS_X" : "ABS_Y";
    if (!facts.axes[axis]) {
      return std::string("it has no axis ") + name +
             (axis == 0 ? "" : ": write event_axes = 1 in its [[device]]");
    }
    if (facts.axes[axis]->maximum <= facts.axes[axis]->minimum)
      return std::string("it reports no range of ") + name + ", so its position is unknown";
  }
  return {};
}

bool ask_state(EventCalls& calls, int file, EventState& state) noexcept {
  std::array<std::int32_t, EventState::kAxes> axes{};
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    const auto info = ask_axis(calls, file, axis);
    if (axis == 0 && !info) return false;
    if (info) axes[axis] = info->value;
  }
  const Bits<KEY_MAX> keys(calls, file, EVIOCGKEY(kOctetsOfKeys));
  std::uint32_t buttons = 0;
  for (std::size_t i = 0; i < state.codes().size(); ++i)
    if (keys.has(state.codes()[i])) buttons |= 1U << i;
  state.set(axes, buttons);
  return true;
}

std::vector<EventDeviceSeen> event_devices(EventCalls& calls) {
  std::vector<EventDeviceSeen> all;
  for (std::string& path : calls.paths()) {
    const int file = calls.open(path);
    if (file < 0) {
      const bool is_denied = file == -EACCES || file == -EPERM;
      EventFacts facts;
      facts.name = calls.closed_name(path);
      if (facts.name.empty()) continue;
      std::string remedy = is_denied ? calls.denied_remedy(path) : std::string();
      std::string problem = is_denied ? std::string() : std::strerror(-file);
      all.push_back({std::move(path), std::move(facts), std::move(remedy), std::move(problem)});
      continue;
    }
    auto facts = event_facts(calls, file);
    calls.close(file);
    if (facts) all.push_back({std::move(path), std::move(*facts), {}, {}});
  }
  return all;
}

}  // namespace reckon::haptics

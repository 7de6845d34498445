// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/hid/hid_device.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace reckon::haptics {
namespace {

using std::chrono::milliseconds;

// The octets that the kernel has read.
std::span<const std::uint8_t> front(const HidReport& report, int octets) noexcept {
  return report.span().first(std::min(report.span().size(), static_cast<std::size_t>(octets)));
}

}  // namespace

HidDevice::HidDevice(HidCalls& calls, int file, std::string name, PidReports reports)
    : calls_(calls), file_(file), name_(std::move(name)), reports_(std::move(reports)) {
  if (!reports_.has_springs() || !reports_.fault().empty()) return;
  if (auto pool = reports_.pool()) {
    const int octets = calls_.get_feature(file_, pool->span());
    if (octets > 0) {
      const auto report = front(*pool, octets);
      if (const int most = reports_.read_pool(report); most > 0) most_effects_ = most;
      has_room_of_its_own_ = reports_.has_room_of_its_own(report);
    }
  }
  ask_for_places();
}

// Some devices do not answer a request, but send reports on their own.
void HidDevice::ask_for_places() noexcept {
  for (std::size_t axis = 0; axis < reports_.axes().size(); ++axis) {
    if (!reports_.axes()[axis] || places_.is_known[axis]) continue;
    HidReport report = reports_.place_report(axis);
    if (const int octets = calls_.get_input(file_, report.span()); octets > 0)
      static_cast<void>(reports_.take(front(report, octets), places_));
  }
  if (says_where()) return;
  calls_.wait(file_, kFirstReport);
  static_cast<void>(read());
}

bool HidDevice::says_where() const noexcept {
  for (std::size_t axis = 0; axis < reports_.axes().size(); ++axis)
    if (reports_.axes()[axis] && !places_.is_known[axis]) return false;
  return true;
}

std::string HidDevice::fault() const {
  if (!reports_.fault().empty()) return reports_.fault();
  if (!has_room_of_its_own_)
    return "it needs a host that manages its effect memory (no Device Managed Pool), and Reckon "
           "does not";
  if (!says_where()) return "it reports no position before it moves: move it";
  return {};
}

// The device still holds the effects of a program that was killed.
int HidDevice::take() noexcept {
  if (const int result = calls_.take(file_); result < 0) return result;
  effects_ = {};
  for (const PidControl what : {PidControl::stop_all, PidControl::reset, PidControl::enable}) {
    const auto report = reports_.control(what);
    if (!report) continue;
    if (const int result = send(*report); result < 0) return result;
  }
  return 0;
}

// Only the newest report of each ID matters.
int HidDevice::read() noexcept {
  constexpr int kMostAtOnce = 256;
  bool says_any = false;
  for (int i = 0; i < kMostAtOnce; ++i) {
    HidReport report(0, HidReport::kMost);
    const int octets = calls_.read(file_, report.span());
    if (octets == -EAGAIN) break;
    if (octets < 0) return calls_.is_there(file_) ? octets : -ENODEV;
    says_any = reports_.take(front(report, octets), places_) || says_any;
  }
  return says_any ? 0 : -EAGAIN;
}

HidDevice::Effect* HidDevice::effect_of(int id) noexcept {
  const bool is_one = id >= 0 && id < static_cast<int>(effects_.size());
  Effect* const effect = is_one ? &effects_[static_cast<std::size_t>(id)] : nullptr;
  return effect != nullptr && effect->block != 0 ? effect : nullptr;
}

int HidDevice::create(Effect& effect, milliseconds length) noexcept {
  if (const int result = calls_.set_feature(file_, reports_.create().span()); result < 0)
    return result;
  PidLoad load;
  for (int i = 0; i < kTries && load.outcome == PidLoad::Outcome::none; ++i) {
    HidReport report = reports_.load();
    const int octets = calls_.get_feature(file_, report.span());
    if (octets < 0) return octets;
    load = reports_.read_load(front(report, octets));
  }
  if (load.outcome == PidLoad::Outcome::full) return -ENOSPC;
  if (load.outcome != PidLoad::Outcome::done) return -EIO;
  effect = {};
  effect.block = load.block;
  return send(reports_.set_effect(load.block, length));
}

// A new effect gets the conditions of all axes, an existing one only the changed ones.
int HidDevice::upload(ff_effect& wanted) noexcept {
  const bool is_new = wanted.id < 0;
  Effect* effect = effect_of(wanted.id);
  if (is_new) {
    const auto free =
        std::ranges::find_if(effects_, [](const Effect& one) { return one.block == 0; });
    if (free == effects_.end()) return -ENOSPC;
    effect = &*free;
    const int result = create(*effect, milliseconds(wanted.replay.length));
    if (result < 0) return result;
    wanted.id = static_cast<std::int16_t>(free - effects_.begin());
  }
  if (wanted.type != FF_SPRING || effect == nullptr) return -EINVAL;
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    const ff_condition_effect& condition = wanted.u.condition[axis];
    if (!is_new && is_same_condition(condition, effect->sent[axis])) continue;
    const int result = send(reports_.set_condition(effect->block, axis, condition));
    if (result < 0) return result;
    effect->sent[axis] = condition;
  }
  return 0;
}

int HidDevice::erase(int id) noexcept {
  Effect* const effect = effect_of(id);
  if (effect == nullptr) return -EINVAL;
  const std::uint8_t block = std::exchange(effect->block, std::uint8_t{0});
  const int result = send(reports_.operate(block, PidOperation::stop));
  const auto free = reports_.free(block);
  return result < 0 || !free ? result : send(*free);
}

int HidDevice::play(int id, bool on) noexcept {
  const Effect* const effect = effect_of(id);
  if (effect == nullptr) return -EINVAL;
  return send(reports_.operate(effect->block, on ? PidOperation::start : PidOperation::stop));
}

int HidDevice::set_full_gain() noexcept {
  const auto report = reports_.gain();
  return report ? send(*report) : 0;
}

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/wall_effects.hpp"

#include <algorithm>
#include <cerrno>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

constexpr std::array kSides{WallSide::below, WallSide::above};
constexpr std::uint16_t kLengthInEffect = WallEffects::kLength.count();
constexpr int kReportsOfANewEffect = 3;

std::size_t index_of(WallSide side) noexcept { return static_cast<std::size_t>(side); }

bool are_equal(const ff_effect& a, const ff_effect& b) noexcept {
  return is_same_condition(a.u.condition[0], b.u.condition[0]) &&
         is_same_condition(a.u.condition[1], b.u.condition[1]);
}

// Whether the surface of a wall is nearer to the hand than the surface of another.
bool is_nearer(const SpringWall& wall, const SpringWall& than, WallSide side) noexcept {
  return side == WallSide::below ? wall.at > than.at : wall.at < than.at;
}

}  // namespace

WallEffects::WallEffects(EventCalls& calls, const EvdevSettings& settings, const EventFacts& facts,
                         const EventState& state, std::function<nanoseconds()> clock, Look look)
    : calls_(calls),
      settings_(settings),
      facts_(facts),
      state_(state),
      clock_(std::move(clock)),
      look_(std::move(look)) {
  for (ff_effect& effect : effects_) effect.id = -1;
}

int WallEffects::begin(int file, nanoseconds interval, nanoseconds age) noexcept {
  file_ = file;
  interval_ = interval;
  age_ = age;
  drained_ = {};
  changed_ = {};
  books_ = {};
  for (const WallSide side : kSides) {
    ff_effect& effect = effects_[index_of(side)];
    effect = effect_of({}, side, settings_.scale, -1, kLengthInEffect);
    if (const int result = calls_.control(file_, EVIOCSFF, &effect); result < 0) return result;
    line_up(kReportsOfANewEffect, clock_());
  }
  return 0;
}

int WallEffects::play() noexcept {
  played_ = clock_();
  return play_all(1);
}

// Errors do not matter: the kernel erases the effects of a closed file, and a hidraw device ends
// them by itself.
void WallEffects::end() noexcept {
  if (file_ < 0) return;
  static_cast<void>(play_all(0));
  for (ff_effect& effect : effects_) {
    const auto id = static_cast<std::intptr_t>(std::exchange(effect.id, std::int16_t{-1}));
    if (id >= 0) static_cast<void>(calls_.control(file_, EVIOCRMFF, reinterpret_cast<void*>(id)));
  }
  file_ = -1;
}

int WallEffects::show(const SpringModel& asked, nanoseconds& now) noexcept {
  return calls_.waits_for_device(file_) ? show_in_turn(asked, now) : show_at_once(asked, now);
}

PlaceRange WallEffects::places_of(std::size_t axis, nanoseconds longer) const noexcept {
  const double at = place_of(state_.axis(axis), *facts_.axes[axis], settings_.scale);
  const double reach = settings_.max_speed * pdu::to_seconds(settings_.chain + longer) +
                       step_of(*facts_.axes[axis], settings_.scale);
  return {at - reach, at + reach};
}

// Rounding puts a wall a little deeper each time, so an uploaded wall stays if the next one is no
// nearer.
SpringWall WallEffects::next_wall(std::size_t axis, WallSide side,
                                  const SpringWall& wanted) const noexcept {
  const SpringWall& shown = books_.shown().wall(axis, side);
  const SpringWall whole = as_told(wanted, side, settings_.scale);
  if (whole == shown) return shown;
  const SpringWall next =
      as_told(books_.payable(axis, side, wanted, places_of(axis, {})), side, settings_.scale);
  const bool is_alike = next.stiffness == shown.stiffness && next.most == shown.most;
  const bool is_short = is_nearer(whole, next, side);
  return is_alike && is_short && !is_nearer(next, shown, side) ? shown : next;
}

// Books the energy over all positions that the handle may reach until the device has the change.
int WallEffects::tell_side(WallSide side, const SpringModel& model, nanoseconds now) noexcept {
  ff_effect& uploaded = effects_[index_of(side)];
  ff_effect next = effect_of(model, side, settings_.scale, uploaded.id, kLengthInEffect);
  if (!are_equal(next, uploaded)) {
    const int result = calls_.control(file_, EVIOCSFF, &next);
    if (result < 0) return result;
    uploaded = next;
    changed_[index_of(side)] = now;
    line_up(kReportsOfAChange, now);
  }
  const nanoseconds longer = later_than_stated(now);
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(settings_.axes); ++axis) {
    if (books_.shown().wall(axis, side) != model.wall(axis, side))
      books_.book(axis, side, model.wall(axis, side), places_of(axis, longer));
  }
  return 0;
}

int WallEffects::tell_wall(std::size_t axis, WallSide side, const SpringWall& wall,
                           nanoseconds now) noexcept {
  ff_effect& uploaded = effects_[index_of(side)];
  ff_effect next = uploaded;
  next.u.condition[axis] = condition_of(wall, side, settings_.scale);
  if (!are_equal(next, uploaded)) {
    const int result = calls_.control(file_, EVIOCSFF, &next);
    if (result < 0) return result;
    uploaded = next;
    changed_[index_of(side)] = now;
  }
  if (books_.shown().wall(axis, side) != wall)
    books_.book(axis, side, wall, places_of(axis, later_than_stated(now)));
  return 0;
}

int WallEffects::play_one(const ff_effect& effect, std::int32_t value) noexcept {
  if (effect.id < 0) return 0;
  input_event event{};
  event.type = EV_FF;
  event.code = static_cast<std::uint16_t>(effect.id);
  event.value = value;
  return calls_.write(file_, event);
}

int WallEffects::play_all(std::int32_t value) noexcept {
  int result = 0;
  for (const ff_effect& effect : effects_)
    if (const int one = play_one(effect, value); one < 0) result = one;
  line_up(static_cast<int>(effects_.size()), clock_());
  return result;
}

// Time from a reading until the device must have received a change.
nanoseconds WallEffects::left_of_delay() const noexcept {
  return settings_.chain - age_ - kReaction;
}

nanoseconds WallEffects::longest_wait() const noexcept {
  return std::min(left_of_delay(), 2 * kTurns * kReportsOfAChange * interval_);
}

// Delay beyond the declared one of a change uploaded since the reading at `now`. If the kernel
// queues it, the queue's delay follows the call; if the call waits for the device, the delay ends
// with it.
nanoseconds WallEffects::later_than_stated(nanoseconds now) const noexcept {
  constexpr nanoseconds kNone{0};
  const nanoseconds calls = std::max(clock_() - now, kNone);
  if (calls_.waits_for_device(file_)) return std::max(calls - left_of_delay(), kNone);
  return calls + std::max(drained_ - now - longest_wait(), kNone);
}

void WallEffects::line_up(int reports, nanoseconds now) noexcept {
  if (calls_.waits_for_device(file_)) return;
  drained_ = std::max(drained_, now) + kTurns * reports * interval_;
}

bool WallEffects::is_soon_there(nanoseconds now) const noexcept {
  return std::max(drained_, now) + kTurns * kReportsOfAChange * interval_ <= now + longest_wait();
}

// An effect that was played too long ago may have ended or not. The next one is booked as if it
// had, before it is replayed.
int WallEffects::show_at_once(const SpringModel& asked, nanoseconds now) noexcept {
  const bool may_have_ended = now - played_ > kLength / 2;
  if (may_have_ended) books_.forget();
  int result = 0;
  for (const WallSide side : sides_in_turn()) {
    SpringModel next;
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(settings_.axes); ++axis)
      next.wall(axis, side) = next_wall(axis, side, asked.wall(axis, side));
    const bool is_due = (now - changed_[index_of(side)] >= kBetween && is_soon_there(now)) ||
                        asked == SpringModel();
    if ((is_due || may_have_ended) && result >= 0) result = tell_side(side, next, now);
  }
  if (result >= 0 && now - played_ >= kLength / 3) {
    result = play_all(1);
    if (result >= 0) played_ = now;
  }
  return result;
}

// Calls that wait for the device may take long. So a new reading precedes each report, and effects
// that may have ended are replayed without walls.
int WallEffects::show_in_turn(const SpringModel& asked, nanoseconds& now) noexcept {
  const bool may_have_ended = now - played_ > kLength / 2;
  if (may_have_ended) books_.forget();
  const bool is_play_due = now - played_ >= kLength / 3;
  int result = is_play_due && !may_have_ended ? play_in_turn(now, true) : 0;
  for (const WallSide side : sides_in_turn()) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(settings_.axes); ++axis) {
      if (result < 0) return result;
      if (!may_have_ended && now - played_ >= kLength / 3) return result;  // the replay comes first
      const SpringWall next = next_wall(axis, side, asked.wall(axis, side));
      result = tell_wall(axis, side, may_have_ended ? SpringWall() : next, now);
      if (result >= 0) result = look_again(now);
    }
  }
  return may_have_ended && result >= 0 ? play_in_turn(now, false) : result;
}

// The side with the oldest change comes first.
std::array<WallSide, SpringModel::kSides> WallEffects::sides_in_turn() const noexcept {
  auto sides = kSides;
  if (changed_[index_of(sides[1])] < changed_[index_of(sides[0])]) std::swap(sides[0], sides[1]);
  return sides;
}

// Reads the device again if the call took at least half an interval.
int WallEffects::look_again(nanoseconds& now) noexcept {
  return clock_() - now < interval_ / 2 ? 0 : look_(now);
}

// @param has_walls an effect that may have ended in the meantime is not replayed
int WallEffects::play_in_turn(nanoseconds& now, bool has_walls) noexcept {
  const nanoseconds begin = now;
  for (const ff_effect& effect : effects_) {
    if (has_walls && now - played_ > kLength / 2) return 0;
    int result = play_one(effect, 1);
    if (result >= 0) result = look_again(now);
    if (result < 0) return result;
  }
  played_ = begin;
  return 0;
}

}  // namespace reckon::haptics

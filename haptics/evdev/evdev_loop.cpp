// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/evdev_loop.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

constexpr std::array kSides{WallSide::below, WallSide::above};
constexpr std::uint16_t kLengthInEffect = EvdevLoop::kLength.count();
constexpr const char* kPulled =
    "was unplugged while it was set up; it is taken up again as soon as it is there";
constexpr std::int32_t kFullGain = 0xFFFF;
// A condition is a report for each of two axes, of a device of one axis too.
constexpr int kReportsOfAChange = 2;
constexpr int kReportsOfANewEffect = 3;
constexpr int kTurns = 2;  // of the endpoint, until a report is surely there
// In which nothing is read: a reading that is older is none.
constexpr nanoseconds kLongestCall = HapticDevice::kWatchdog - std::chrono::milliseconds(2);

std::size_t index_of(WallSide side) noexcept { return static_cast<std::size_t>(side); }

bool are_equal(const ff_effect& a, const ff_effect& b) noexcept {
  return is_same_condition(a.u.condition[0], b.u.condition[0]) &&
         is_same_condition(a.u.condition[1], b.u.condition[1]);
}

// Whether a wall begins less deep than another of the same spring.
bool is_nearer(const SpringWall& wall, const SpringWall& than, WallSide side) noexcept {
  return side == WallSide::below ? wall.at > than.at : wall.at < than.at;
}

}  // namespace

EvdevLoop::EvdevLoop(EvdevExchange& exchange, const EvdevSettings& settings,
                     std::unique_ptr<EventCalls> calls, std::function<nanoseconds()> clock)
    : exchange_(exchange), settings_(settings), calls_(std::move(calls)), clock_(std::move(clock)) {
  for (ff_effect& effect : effects_) effect.id = -1;
  static_cast<void>(evdev_limits(settings));
}

EvdevLoop::~EvdevLoop() { let_go(); }

void EvdevLoop::tell(std::string sentence) {
  const std::string name = facts_.name.empty() ? "evdev" : facts_.name;
  const std::lock_guard lock(telling_);
  notices_.push_back(name + ": " + std::move(sentence));
}

std::vector<std::string> EvdevLoop::take_notices() {
  const std::lock_guard lock(telling_);
  return std::exchange(notices_, {});
}

void EvdevLoop::step(microseconds longest) {
  if (file_ < 0) {
    if (clock_() >= next_try_) return attach();
    calls_->wait(-1, longest);
    return publish(clock_());
  }
  calls_->wait(file_, longest);
  if (!read_events()) return detach("was unplugged");
  nanoseconds now = clock_();
  if (calls_->waits_for_device(file_)) {
    publish(now);
    judge(show_in_turn(now));
  } else {
    judge(show(now));
  }
  publish(now);
}

// The kernel hands out what it has. A device that is gone says so.
bool EvdevLoop::read_events() noexcept {
  std::array<input_event, 64> events{};
  while (true) {
    const int count = calls_->read(file_, events);
    if (count == -EAGAIN) break;
    if (count < 0) return false;
    for (int i = 0; i < count; ++i) state_.take(events[static_cast<std::size_t>(i)]);
    placed_at_ = clock_();
    if (count < static_cast<int>(events.size())) break;
  }
  return !state_.wants_all() || ask_state(*calls_, file_, state_);
}

// A servo that is silent wants no walls.
SpringModel EvdevLoop::wanted(nanoseconds now) noexcept {
  exchange_.model.update();
  const StatedModel& stated = exchange_.model.read();
  if (!stated.is_stated || now - stated.at > HapticDevice::kWatchdog) return {};
  return stated.model;
}

PlaceRange EvdevLoop::places_of(std::size_t axis, nanoseconds longer) const noexcept {
  const double at = place_of(state_.axis(axis), *facts_.axes[axis], settings_.scale);
  const double reach = settings_.max_speed * pdu::to_seconds(settings_.chain + longer) +
                       step_of(*facts_.axes[axis], settings_.scale);
  return {at - reach, at + reach};
}

// Rounding makes a wall begin a little deeper each time: what is told already stays, where it is as
// near.
SpringWall EvdevLoop::next_wall(std::size_t axis, WallSide side,
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

// What is booked is what may have become of it until the device has it.
int EvdevLoop::tell_side(WallSide side, const SpringModel& model, nanoseconds now) noexcept {
  ff_effect& told = effects_[index_of(side)];
  ff_effect next = effect_of(model, side, settings_.scale, told.id, kLengthInEffect);
  if (!are_equal(next, told)) {
    const int result = calls_->control(file_, EVIOCSFF, &next);
    if (result < 0) return result;
    told = next;
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

int EvdevLoop::tell_wall(std::size_t axis, WallSide side, const SpringWall& wall,
                         nanoseconds now) noexcept {
  ff_effect& told = effects_[index_of(side)];
  ff_effect next = told;
  next.u.condition[axis] = condition_of(wall, side, settings_.scale);
  if (!are_equal(next, told)) {
    const int result = calls_->control(file_, EVIOCSFF, &next);
    if (result < 0) return result;
    told = next;
    changed_[index_of(side)] = now;
  }
  if (books_.shown().wall(axis, side) != wall)
    books_.book(axis, side, wall, places_of(axis, later_than_stated(now)));
  return 0;
}

int EvdevLoop::play_one(const ff_effect& effect, std::int32_t value) noexcept {
  if (effect.id < 0) return 0;
  input_event event{};
  event.type = EV_FF;
  event.code = static_cast<std::uint16_t>(effect.id);
  event.value = value;
  return calls_->write(file_, event);
}

int EvdevLoop::play(std::int32_t value) noexcept {
  int result = 0;
  for (const ff_effect& effect : effects_)
    if (const int one = play_one(effect, value); one < 0) result = one;
  line_up(static_cast<int>(effects_.size()), clock_());
  return result;
}

// Of what was told since a reading. Where the kernel sends it by and by, the stated time begins
// when the call returns; where the call waits for the device, a reading is two turns old at most.
nanoseconds EvdevLoop::later_than_stated(nanoseconds now) const noexcept {
  constexpr nanoseconds kNone{0};
  const nanoseconds calls = std::max(clock_() - now, kNone);
  if (calls_->waits_for_device(file_))
    return std::max(calls + kTurns * interval_ - settings_.chain, kNone);
  return calls + std::max(drained_ - now - settings_.chain, kNone);
}

void EvdevLoop::line_up(int reports, nanoseconds now) noexcept {
  if (calls_->waits_for_device(file_)) return;
  drained_ = std::max(drained_, now) + kTurns * reports * interval_;
}

bool EvdevLoop::is_soon_there(nanoseconds now) const noexcept {
  return std::max(drained_, now) + kTurns * kReportsOfAChange * interval_ <= now + settings_.chain;
}

// Why the device is too slow for the delay that is stated, as a sentence.
std::string EvdevLoop::learn_interval(const std::string& path, int file) {
  const microseconds told = calls_->report_interval(path);
  constexpr int kIntervals = kTurns * kReportsOfAChange;
  interval_ = told.count() > 0 ? nanoseconds(told)
                               : std::min<nanoseconds>(kReport, settings_.chain / kIntervals);
  drained_ = {};
  if (calls_->waits_for_device(file) && kReportsOfAChange * interval_ > kLongestCall) {
    return "it takes a report each " + std::to_string(told.count()) +
           " us and each is waited for, so that it would not be read for too long";
  }
  const nanoseconds change = kIntervals * interval_;
  if (change <= settings_.chain) return {};
  return "it takes a report each " + std::to_string(told.count()) +
         " us, and a change is two: state a delay of " +
         std::to_string(std::chrono::ceil<std::chrono::milliseconds>(change).count()) +
         " ms or more in its [[device]]";
}

// An effect that was played too long ago may have ended, or not: the next one is paid for as if it
// had, before it is played again.
int EvdevLoop::show(nanoseconds now) noexcept {
  const SpringModel asked = wanted(now);
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
    result = play(1);
    if (result >= 0) played_ = now;
  }
  return result;
}

// Where each call waits for the device, any of them may take long. So each report follows a
// reading, and effects that may have ended are played again without walls.
int EvdevLoop::show_in_turn(nanoseconds& now) noexcept {
  const SpringModel asked = wanted(now);
  const bool may_have_ended = now - played_ > kLength / 2;
  if (may_have_ended) books_.forget();
  const bool is_play_due = now - played_ >= kLength / 3;
  int result = is_play_due && !may_have_ended ? play_in_turn(now, true) : 0;
  for (const WallSide side : sides_in_turn()) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(settings_.axes); ++axis) {
      if (result < 0) return result;
      if (!may_have_ended && now - played_ >= kLength / 3) return result;  // to play is first
      const SpringWall next = next_wall(axis, side, asked.wall(axis, side));
      result = tell_wall(axis, side, may_have_ended ? SpringWall() : next, now);
      if (result >= 0) result = look_again(now);
    }
  }
  return may_have_ended && result >= 0 ? play_in_turn(now, false) : result;
}

// Which waits longest is first.
std::array<WallSide, SpringModel::kSides> EvdevLoop::sides_in_turn() const noexcept {
  auto sides = kSides;
  if (changed_[index_of(sides[1])] < changed_[index_of(sides[0])]) std::swap(sides[0], sides[1]);
  return sides;
}

// Readings would age meanwhile.
int EvdevLoop::look_again(nanoseconds& now) noexcept {
  if (clock_() == now) return 0;
  if (!read_events()) return -ENODEV;
  now = clock_();
  publish(now);
  return 0;
}

// @param has_walls one that may have ended meanwhile is not played
int EvdevLoop::play_in_turn(nanoseconds& now, bool has_walls) noexcept {
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

void EvdevLoop::judge(int result) {
  if (result == -EAGAIN) return;  // it is asked again in the next step
  if (result == -ENODEV) return detach("was unplugged");
  if (result < 0) detach(std::string("refuses an effect (") + std::strerror(-result) + ")");
}

// A handle that moves says where it is in each turn of its endpoint.
void EvdevLoop::publish(nanoseconds now) noexcept {
  if (now - placed_at_ > kTurns * interval_) placed_at_ = now;
  EvdevReading& reading = exchange_.reading.write_slot();
  reading = {};
  reading.at = now;
  reading.placed_at = placed_at_;
  reading.is_there = file_ >= 0;
  if (reading.is_there) {
    for (std::size_t axis = 0; axis < static_cast<std::size_t>(settings_.axes); ++axis) {
      reading.position[static_cast<Eigen::Index>(axis)] =
          place_of(state_.axis(axis), *facts_.axes[axis], settings_.scale);
    }
    reading.buttons = state_.buttons();
    reading.shown = {books_.shown(), books_.energy()};
  }
  exchange_.reading.publish();
}

// What cannot be told does not matter: the kernel erases what a closed file had.
void EvdevLoop::let_go() noexcept {
  if (file_ < 0) return;
  static_cast<void>(play(0));
  for (ff_effect& effect : effects_) {
    const auto id = static_cast<std::intptr_t>(std::exchange(effect.id, std::int16_t{-1}));
    if (id >= 0) static_cast<void>(calls_->control(file_, EVIOCRMFF, reinterpret_cast<void*>(id)));
  }
  calls_->close(std::exchange(file_, -1));
}

void EvdevLoop::detach(const std::string& why) {
  let_go();
  problem_.clear();
  next_try_ = clock_() + kRetry;
  publish(clock_());
  tell(why + ": it shows nothing; it is taken up again as soon as it is there");
}

// Another program that has the device for itself gets all its places, and we none.
std::string EvdevLoop::set_up() {
  int result = calls_->control(file_, EVIOCGRAB, reinterpret_cast<void*>(std::intptr_t{1}));
  if (result == -EBUSY) return "another program has it for itself: end that one";
  if (result < 0) return std::string("it cannot be taken: ") + std::strerror(-result);
  const auto set = [&](std::uint16_t code, std::int32_t value) {
    input_event event{};
    event.type = EV_FF;
    event.code = code;
    event.value = value;
    return calls_->write(file_, event);
  };
  if (facts_.has_autocenter) result = set(FF_AUTOCENTER, 0);
  if (result >= 0 && facts_.has_gain) result = set(FF_GAIN, kFullGain);
  if (result < 0) return std::string("its gain cannot be set: ") + std::strerror(-result);
  for (const WallSide side : kSides) {
    ff_effect& effect = effects_[index_of(side)];
    effect = effect_of({}, side, settings_.scale, -1, kLengthInEffect);
    result = calls_->control(file_, EVIOCSFF, &effect);
    if (result == -ENOSPC) return "it has no room for two effects: end what else uses it";
    if (result < 0) return std::string("it takes no spring: ") + std::strerror(-result);
    line_up(kReportsOfANewEffect, clock_());
  }
  result = play(1);
  if (result < 0) return std::string("it plays no spring: ") + std::strerror(-result);
  state_ = EventState(facts_.buttons);
  if (!ask_state(*calls_, file_, state_)) return "it does not tell where it is";
  return {};
}

// What is in the way, as a sentence; empty: it is set up, and file_ is its own.
std::string EvdevLoop::open_one(const std::string& path, bool by_path) {
  const auto is_named = [&](const std::string& name) {
    return by_path || (!name.empty() && name.find(settings_.event) != std::string::npos);
  };
  const int file = calls_->open(path);
  const bool is_gone_already = file == -ENOENT || file == -ENODEV || file == -ENXIO;
  if (is_gone_already && !by_path) return "none";
  if (file < 0 && !is_named(calls_->closed_name(path))) return "none";
  if (file == -EACCES || file == -EPERM)
    return "this user may not open " + path + ": " + calls_->denied_remedy(path);
  if (file < 0) return path + " cannot be opened: " + std::strerror(-file);
  auto facts = event_facts(*calls_, file);
  const bool is_meant = is_named(facts ? facts->name : std::string());
  std::string fault;
  if (!is_meant || !facts) {
    fault = is_meant ? path + " gives no force feedback" : "none";
  } else {
    fault = fault_of(*facts, settings_.axes);
    if (fault.empty()) fault = learn_interval(path, file);
  }
  if (!fault.empty()) {
    const bool was_pulled = is_gone(file);
    calls_->close(file);
    if (was_pulled) return kPulled;
    return is_meant && facts ? facts->name + ": " + fault : fault;
  }
  facts_ = std::move(*facts);
  file_ = file;
  fault = set_up();
  return !fault.empty() && is_gone(file) ? kPulled : fault;
}

// Whatever failed of a device that is pulled out: it says nothing of the device.
bool EvdevLoop::is_gone(int file) noexcept {
  int version = 0;
  return calls_->control(file, EVIOCGVERSION, &version) == -ENODEV;
}

std::string EvdevLoop::open() {
  const bool by_path = settings_.event.starts_with('/');
  if (by_path) return open_one(settings_.event, true);
  std::string nearest;
  for (const std::string& path : calls_->paths()) {
    std::string fault = open_one(path, false);
    if (fault.empty()) return {};
    let_go();
    if (fault != "none") nearest = std::move(fault);
  }
  if (!nearest.empty()) return nearest;
  return settings_.event.empty()
             ? "no device with force feedback is attached (reckon devices tells what there is)"
             : "no device whose name has '" + settings_.event + "' is attached";
}

void EvdevLoop::attach() {
  std::string problem = open();
  const nanoseconds now = clock_();
  next_try_ = now + kRetry;
  if (!problem.empty()) {
    let_go();
    publish(now);
    if (problem != problem_) tell(problem);
    problem_ = std::move(problem);
    return;
  }
  problem_.clear();
  books_ = {};
  changed_ = {};
  played_ = now;
  publish(now);
  tell("ready: it renders walls");
}

}  // namespace reckon::haptics

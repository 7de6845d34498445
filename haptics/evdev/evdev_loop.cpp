// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/evdev_loop.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace reckon::haptics {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

constexpr const char* kPulled = "was unplugged during set-up; it reconnects automatically";
constexpr std::int32_t kFullGain = 0xFFFF;
// No reading is taken during a call, and one older than kWatchdog is invalid.
constexpr nanoseconds kLongestCall = HapticDevice::kWatchdog - std::chrono::milliseconds(2);

// The errors of USB when a device does not answer.
std::string refusal_of(int result) {
  const std::string error = std::strerror(-result);
  const bool is_silent = result == -EPROTO || result == -EILSEQ || result == -ETIME;
  return is_silent ? "does not answer (" + error + "), as if unplugged"
                   : "refuses an effect (" + error + ")";
}

}  // namespace

EvdevLoop::EvdevLoop(EvdevExchange& exchange, const EvdevSettings& settings,
                     std::unique_ptr<EventCalls> calls, SteadyTime time)
    : DeviceSession(std::move(time), kRetry),
      exchange_(exchange),
      settings_(settings),
      calls_(std::move(calls)),
      walls_(*calls_, settings_, facts_, state_, this->time(),
             [this](nanoseconds& now) { return look(now); }) {
  static_cast<void>(evdev_limits(settings));
}

EvdevLoop::~EvdevLoop() { close_device(); }

std::string EvdevLoop::name() const { return facts_.name.empty() ? "evdev" : facts_.name; }

void EvdevLoop::wait(microseconds longest) {
  calls_->wait(-1, longest);
  publish(now());
}

void EvdevLoop::exchange(microseconds longest) {
  calls_->wait(file_, longest);
  if (!read_events()) return detach("was unplugged");
  nanoseconds time = now();
  if (calls_->waits_for_device(file_)) publish(time);
  const int result = walls_.show(wanted(time), time);
  if (result == -ENODEV) return detach("was unplugged");
  const bool is_asked_again = result == -EAGAIN;  // repeated in the next step
  if (result < 0 && !is_asked_again) return detach(refusal_of(result));
  publish(time);
}

int EvdevLoop::look(nanoseconds& time) noexcept {
  if (!read_events()) return -ENODEV;
  time = now();
  publish(time);
  return 0;
}

// Reads all events that the kernel has queued. @return false: the device is gone
bool EvdevLoop::read_events() noexcept {
  std::array<input_event, 64> events{};
  while (true) {
    const int count = calls_->read(file_, events);
    if (count == -EAGAIN) break;
    if (count < 0) return false;
    for (int i = 0; i < count; ++i) state_.take(events[static_cast<std::size_t>(i)]);
    placed_at_ = now();
    if (count < static_cast<int>(events.size())) break;
  }
  return !state_.wants_all() || ask_state(*calls_, file_, state_);
}

// No walls when the servo has stopped.
SpringModel EvdevLoop::wanted(nanoseconds now) noexcept {
  exchange_.model.update();
  const StatedModel& stated = exchange_.model.read();
  if (!stated.is_stated || now - stated.at > HapticDevice::kWatchdog) return {};
  return stated.model;
}

// @return why the device is too slow for the declared delay, as a sentence; empty: it is fast
// enough
std::string EvdevLoop::learn_intervals(const std::string& path, int file) {
  const ReportIntervals intervals = calls_->report_intervals(path);
  constexpr int kTurns = WallEffects::kTurns, kReports = WallEffects::kReportsOfAChange;
  const nanoseconds rest = settings_.chain - WallEffects::kReaction;
  interval_ =
      intervals.takes.count() > 0
          ? nanoseconds(intervals.takes)
          : std::clamp<nanoseconds>(rest / (kTurns * (kReports + 1)), microseconds(1), kReport);
  age_ = kTurns * (intervals.sends.count() > 0 ? nanoseconds(intervals.sends) : interval_);
  const auto text = [](nanoseconds time) {
    return std::to_string(std::chrono::ceil<microseconds>(time).count()) + " us";
  };
  if (calls_->waits_for_device(file) && kReports * interval_ > kLongestCall) {
    return "it accepts a report every " + text(interval_) +
           ", and nothing is read while each is sent: use the driver of Linux (CONFIG_HID_PID)";
  }
  const nanoseconds change = age_ + kTurns * kReports * interval_ + WallEffects::kReaction;
  if (change <= settings_.chain) return {};
  return "it sends a report every " + text(age_ / kTurns) + " and accepts one every " +
         text(interval_) + ", and a change takes two: write a delay of " +
         std::to_string(std::chrono::ceil<std::chrono::milliseconds>(change).count()) +
         " ms or more in its [[device]]";
}

// A moving handle is in each report; without one for `age_` it is still at its last position.
void EvdevLoop::publish(nanoseconds now) noexcept {
  if (now - placed_at_ > age_) placed_at_ = now;
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
    reading.shown = {walls_.books().shown(), walls_.books().energy()};
  }
  exchange_.reading.publish();
}

void EvdevLoop::close_device() noexcept {
  if (file_ < 0) return;
  walls_.end();
  calls_->close(std::exchange(file_, -1));
}

void EvdevLoop::detach(const std::string& why) {
  close_device();
  clear_problem();
  retry_after(kRetry);
  publish(now());
  tell(why + ": it renders nothing" + kIsTakenUpAgain);
}

// A program that has grabbed the device (EVIOCGRAB) receives all its events, and this one none.
std::string EvdevLoop::set_up() {
  int result = calls_->control(file_, EVIOCGRAB, reinterpret_cast<void*>(std::intptr_t{1}));
  if (result == -EBUSY) return "another program has grabbed it: end that program";
  if (result < 0) return std::string("it cannot be grabbed: ") + std::strerror(-result);
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
  result = walls_.begin(file_, interval_, age_);
  if (result == -ENOSPC) return "it has no room for two effects: end other programs that use it";
  if (result < 0) return std::string("it accepts no spring effect: ") + std::strerror(-result);
  result = walls_.play();
  if (result < 0) return std::string("it plays no spring effect: ") + std::strerror(-result);
  state_ = EventState(facts_.buttons);
  if (!ask_state(*calls_, file_, state_)) return "it does not report its position";
  return {};
}

// @return why the device is not used, as a sentence; empty: it is set up, and file_ is open
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
    fault = calls_->fault(file);
    fault = !is_meant ? "none" : path + (fault.empty() ? " has no force feedback" : ": " + fault);
  } else {
    fault = fault_of(*facts, settings_.axes);
    if (fault.empty()) fault = learn_intervals(path, file);
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

// An error of an unplugged device is no fault of the device.
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
    close_device();
    if (fault != "none") nearest = std::move(fault);
  }
  if (!nearest.empty()) return nearest;
  return settings_.event.empty()
             ? "no device with force feedback is attached (`reckon devices` lists devices)"
             : "no device with a name that contains '" + settings_.event + "' is attached";
}

void EvdevLoop::opened(nanoseconds now, std::string& problem) {
  if (!problem.empty()) {
    close_device();
    return publish(now);
  }
  clear_problem();
  publish(now);
  tell("ready: it renders walls");
}

}  // namespace reckon::haptics

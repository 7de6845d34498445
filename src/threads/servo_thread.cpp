// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/servo_thread.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <latch>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "reckon/peer/threads/awake_processors.hpp"
#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::peer {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

// Waking another thread takes some microseconds; with less time to the next step it is postponed.
constexpr nanoseconds kTimeToTell = microseconds(20);

}  // namespace

ServoThread::ServoThread(const Clock& clock, const ServoThreadOptions& options)
    : clock_(clock), options_(options) {
  std::latch ready(1);
  const auto serve = [this, &ready] {
    std::optional<RealTimePriority> priority;
    if (pulse_) priority.emplace(kPriority, *pulse_);
    real_time_ = priority && priority->held();
    spin_ = real_time_ ? options_.spin : nanoseconds(0);
    ready.count_down();
    run(priority);
  };
  try {
    if (options_.real_time) {
      pulse_.emplace(clock_, options_.starvation);
    }
    thread_ = std::thread(serve);
    name_thread(thread_.native_handle(), options_.name);
  } catch (const std::system_error& error) {
    throw std::system_error(error.code(),
                            "the servo thread cannot be started; raise ulimit -u (or ulimit -v), "
                            "or pids.max of the process's control group");
  }
  ready.wait();
}

void ServoThread::stop() noexcept {
  stop_ = true;
  changed_.notify();
  if (thread_.joinable()) thread_.join();
}

std::size_t ServoThread::add(Servo servo) {
  const std::lock_guard lock(adding_);
  const auto seat = std::find_if(seats_.begin(), seats_.end(),
                                 [](const Seat& s) { return s.state.load() == State::free; });
  if (seat == seats_.end()) {
    throw std::runtime_error(fmt::format(
        "a servo thread serves at most {} servos: create another ServoThread", kMostServos));
  }
  const auto number = static_cast<std::size_t>(seat - seats_.begin());
  seat->servo = std::move(servo);
  seat->due = clock_.now() + seat->servo.period;
  seat->untold = false;
  seat->state.store(State::served, std::memory_order_release);
  seats_used_.store(std::max(seats_used_.load(), number + 1), std::memory_order_release);
  changed_.notify();
  return number;
}

void ServoThread::remove(std::size_t number) noexcept {
  const std::lock_guard lock(adding_);
  Seat& seat = seats_[number];
  seat.state.store(State::leaving, std::memory_order_release);
  changed_.notify();
  while (seat.state.load(std::memory_order_acquire) != State::free) left_.wait(nanoseconds::max());
  seat.servo = {};
}

std::string ServoThread::describe() const {
  if (!options_.real_time) return "SCHED_OTHER as requested, wakes when a step is due";
  const std::string_view remedy =
      gave_way_ ? ": it starved other threads; use fewer devices or a lower rate" : "";
  if (gave_way_ && !real_time_) return fmt::format("gave SCHED_FIFO up{}", remedy);
  if (!real_time_) return "no real-time privilege (see reckon doctor), wakes when a step is due";
  const auto early = std::chrono::duration_cast<microseconds>(spin_.load()).count();
  if (early == 0)
    return fmt::format("SCHED_FIFO {}, wakes when a step is due{}", kPriority, remedy);
  return fmt::format("SCHED_FIFO {}, wakes {} us early and spins near touchable objects{}",
                     kPriority, early,
                     AwakeProcessors::is_allowed() ? "; processors stay awake then" : "");
}

void ServoThread::run(std::optional<RealTimePriority>& priority) noexcept {
  std::optional<AwakeProcessors> awake;
  if (real_time_) awake.emplace();
  while (!stop_.load(std::memory_order_relaxed)) {
    Seat* const next = next_due();
    const nanoseconds left = next == nullptr ? nanoseconds::max() : next->due - clock_.now();
    if (left > kTimeToTell || next->untold) tell();
    if (priority) leave_time(*priority);
    const bool urgent = next != nullptr && is_urgent();
    if (awake)
      awake->keep(urgent && real_time_, next == nullptr ? nanoseconds::max() : clock_.now());
    const nanoseconds spin = urgent ? spin_.load(std::memory_order_relaxed) : nanoseconds(0);
    if (left > spin) {
      changed_.wait(next == nullptr ? left : left - spin);
    } else {
      step(*next);
    }
  }
}

// The earliest seat in use; frees the seats of removed servos.
ServoThread::Seat* ServoThread::next_due() noexcept {
  Seat* next = nullptr;
  const std::size_t used = seats_used_.load(std::memory_order_acquire);
  for (std::size_t i = 0; i < used; ++i) {
    Seat& seat = seats_[i];
    const State state = seat.state.load(std::memory_order_acquire);
    if (state == State::leaving) {
      seat.state.store(State::free, std::memory_order_release);
      left_.notify();
    } else if (state == State::served && (next == nullptr || seat.due < next->due)) {
      next = &seat;
    }
  }
  return next;
}

// If one servo needs a punctual step, all do: they share the thread.
bool ServoThread::is_urgent() const noexcept {
  const auto used = std::span(seats_).first(seats_used_.load(std::memory_order_acquire));
  return std::ranges::any_of(used, [](const Seat& seat) {
    return seat.state.load(std::memory_order_acquire) == State::served &&
           (!seat.servo.is_urgent || seat.servo.is_urgent());
  });
}

void ServoThread::step(Seat& seat) noexcept {
  nanoseconds started = clock_.now();
  while (started < seat.due) started = clock_.now();
  seat.servo.step(started);
  const nanoseconds finished = clock_.now();
  if (seat.servo.duty != nullptr) seat.servo.duty->record(seat.due, started, finished);
  seat.untold = true;

  // Missed periods are counted, not made up for: a burst of steps would have wrong times.
  seat.due += seat.servo.period;
  if (seat.due < finished) {
    constexpr nanoseconds kOne{1};  // one that is due now is not skipped
    seat.due += ((finished - seat.due - kOne) / seat.servo.period + 1) * seat.servo.period;
  }
}

// Spinning costs up to a core; without it wake-ups are some tens of microseconds late. It is given
// up first.
void ServoThread::leave_time(RealTimePriority& priority) noexcept {
  if (!priority.starves_others(clock_.now())) return;
  gave_way_ = true;
  if (spin_.load() > nanoseconds(0)) {
    spin_ = nanoseconds(0);
  } else {
    priority.give_up();
    real_time_ = false;
  }
}

void ServoThread::tell() noexcept {
  const std::size_t used = seats_used_.load(std::memory_order_acquire);
  for (std::size_t i = 0; i < used; ++i) {
    Seat& seat = seats_[i];
    if (seat.state.load(std::memory_order_acquire) != State::served || !seat.untold) continue;
    seat.untold = false;
    if (seat.servo.tell) seat.servo.tell();
  }
}

}  // namespace reckon::peer

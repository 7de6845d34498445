// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/real_time_priority.hpp"

#include <pthread.h>
#include <sched.h>

#include "reckon/peer/threads/cpu_time.hpp"
#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

bool schedule(int policy, int priority) noexcept {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), policy, &parameters) == 0;
}

}  // namespace

OrdinaryPulse::OrdinaryPulse(const Clock& clock, nanoseconds silence)
    : clock_(clock), silence_(silence) {
  beat();
  thread_ = std::thread([this] {
    schedule(SCHED_OTHER, 0);  // regardless of the creating thread
    while (!stop_.load(std::memory_order_relaxed)) {
      ends_.wait(silence_ / 10);
      beat();
    }
  });
  name_thread(thread_.native_handle(), "rk-pulse");
}

OrdinaryPulse::~OrdinaryPulse() {
  stop_ = true;
  ends_.notify();
  thread_.join();
}

void OrdinaryPulse::beat() noexcept {
  processor_time_.store(process_cpu_time(), std::memory_order_relaxed);
  last_.store(clock_.now(), std::memory_order_release);
}

bool OrdinaryPulse::starves(nanoseconds now) const noexcept {
  const nanoseconds silent = now - last_.load(std::memory_order_acquire);
  if (silent < silence_) return false;
  const nanoseconds spent = process_cpu_time() - processor_time_.load(std::memory_order_relaxed);
  return starves_ordinary_threads(silent, spent, silence_);
}

RealTimePriority::RealTimePriority(int priority, const OrdinaryPulse& pulse) noexcept
    : pulse_(pulse), held_(schedule(SCHED_FIFO, priority)) {}

bool RealTimePriority::starves_others(nanoseconds now) noexcept {
  if (!held_ || now < judged_from_ || !pulse_.starves(now)) return false;
  judged_from_ = now + pulse_.longest_silence();
  return true;
}

void RealTimePriority::give_up() noexcept {
  schedule(SCHED_OTHER, 0);
  held_ = false;
}

}  // namespace reckon::peer

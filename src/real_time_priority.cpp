// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/real_time_priority.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

bool schedule(int policy, int priority) noexcept {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), policy, &parameters) == 0;
}

// Among ordinary threads that compute it is to come in time: they are no reason to give way.
void become_ordinary_but_prompt() noexcept {
  schedule(SCHED_OTHER, 0);
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), -20);
}

}  // namespace

OrdinaryPulse::OrdinaryPulse(nanoseconds beat) : beat_(beat) {
  thread_ = std::thread([this] {
    become_ordinary_but_prompt();
    while (!stop_.load(std::memory_order_relaxed)) {
      ends_.wait(beat_);
      beats_.fetch_add(1, std::memory_order_relaxed);
    }
  });
}

OrdinaryPulse::~OrdinaryPulse() {
  stop_ = true;
  ends_.notify();
  thread_.join();
}

bool StarvationWatch::starved(nanoseconds now) noexcept {
  if (!last_) first_ = pulse_.beats();
  watched_ += std::clamp(now - last_.value_or(now), nanoseconds(0), pulse_.beat());
  last_ = now;
  if (watched_ < static_cast<std::int64_t>(kBeats) * pulse_.beat()) return false;
  const std::uint64_t beats = pulse_.beats();
  const bool few = beats - first_ < kFewest;
  first_ = beats;
  watched_ = nanoseconds(0);
  return few;
}

RealTimePriority::RealTimePriority(int priority, const OrdinaryPulse& pulse) noexcept
    : watch_(pulse), held_(schedule(SCHED_FIFO, priority)) {}

void RealTimePriority::give_up() noexcept {
  schedule(SCHED_OTHER, 0);
  held_ = false;
}

}  // namespace reckon::peer

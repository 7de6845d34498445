// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/peer_threads.hpp"

#include <pthread.h>
#include <sched.h>
#include <time.h>

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr int kServoPriority = 50;

bool ask_for_real_time() noexcept {
  sched_param parameters{};
  parameters.sched_priority = kServoPriority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

// Relative to the clock's own idea of now, so that any steady clock will do.
void sleep_for(nanoseconds duration) noexcept {
  if (duration <= nanoseconds(0)) return;
  timespec wait{};
  wait.tv_sec = static_cast<time_t>(duration.count() / 1'000'000'000);
  wait.tv_nsec = static_cast<long>(duration.count() % 1'000'000'000);
  clock_nanosleep(CLOCK_MONOTONIC, 0, &wait, nullptr);
}

}  // namespace

PeerThreads::PeerThreads(Peer& peer, const Clock& clock, const PeerThreadsOptions& options)
    : peer_(peer), clock_(clock), options_(options), duty_(options.servo_period) {
  read_ = std::jthread([this] { run_read(); });
  write_ = std::jthread([this] { run_write(); });
  model_ = std::jthread([this] { run_model(); });
  servo_ = std::jthread([this] { run_servo(); });
}

void PeerThreads::stop() noexcept {
  stop_ = true;
  peer_.link().wake();
  to_write_.fetch_add(1, std::memory_order_release);
  to_write_.notify_all();
  for (std::jthread* thread : {&servo_, &model_, &read_, &write_}) {
    if (thread->joinable()) thread->join();
  }
}

void PeerThreads::run_servo() noexcept {
  real_time_ = options_.real_time && ask_for_real_time();
  const nanoseconds spin = real_time_ ? options_.spin : nanoseconds(0);
  nanoseconds scheduled = clock_.now() + options_.servo_period;
  while (!stop_.load(std::memory_order_relaxed)) {
    sleep_for(scheduled - spin - clock_.now());
    nanoseconds started = clock_.now();
    while (started < scheduled) started = clock_.now();

    peer_.servo_step(started);
    const nanoseconds finished = clock_.now();
    duty_.record(scheduled, started, finished);

    // Missed periods are counted, not made up for: a burst of steps would be a lie about time.
    scheduled += options_.servo_period;
    if (scheduled < finished) {
      const auto behind = (finished - scheduled) / options_.servo_period + 1;
      scheduled += behind * options_.servo_period;
    }
  }
}

void PeerThreads::run_read() noexcept {
  while (!stop_.load(std::memory_order_relaxed)) {
    // Wakes for a datagram, or soon enough for a group to join.
    peer_.link().wait(std::chrono::milliseconds(5));
    peer_.read_step(clock_.now());
  }
}

void PeerThreads::run_model() noexcept {
  nanoseconds scheduled = clock_.now();
  while (!stop_.load(std::memory_order_relaxed)) {
    peer_.model_step(clock_.now(), clock_.utc_now());
    to_write_.fetch_add(1, std::memory_order_release);
    to_write_.notify_one();
    scheduled = std::max(scheduled + options_.model_period, clock_.now());
    sleep_for(scheduled - clock_.now());
  }
}

void PeerThreads::run_write() noexcept {
  std::uint32_t seen = 0;
  while (!stop_.load(std::memory_order_relaxed)) {
    to_write_.wait(seen, std::memory_order_acquire);
    seen = to_write_.load(std::memory_order_acquire);
    peer_.write_step();
  }
}

}  // namespace reckon::peer

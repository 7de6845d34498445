// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/evdev_thread.hpp"

#include <chrono>
#include <utility>

#include "reckon/peer/thread_name.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::microseconds kLongestTurn{1000};
constexpr std::chrono::milliseconds kStarved{500};

}  // namespace

EvdevThread::EvdevThread(const Clock& clock, const haptics::EvdevSettings& settings,
                         std::unique_ptr<haptics::EventCalls> calls)
    : clock_(clock),
      device_(exchange_, haptics::evdev_limits(settings)),
      loop_(exchange_, settings, std::move(calls), [&clock] { return clock.now(); }),
      pulse_(clock, kStarved),
      thread_([this] { run(); }) {
  name_thread(thread_.native_handle(), "rk-evdev");
}

EvdevThread::~EvdevThread() {
  stop_ = true;
  thread_.join();
}

void EvdevThread::run() noexcept {
  RealTimePriority priority(kPriority, pulse_);
  while (!stop_) {
    loop_.step(kLongestTurn);
    if (priority.starves_others(clock_.now())) priority.give_up();
  }
}

}  // namespace reckon::peer

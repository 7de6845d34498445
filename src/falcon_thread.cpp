// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/falcon_thread.hpp"

#include <chrono>
#include <utility>

#include "reckon/peer/thread_name.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::microseconds kLongestWait{1000};
constexpr std::chrono::milliseconds kSilence{500};

haptics::FalconLoopOptions options_of(const Clock& clock, haptics::FalconFirmware firmware) {
  haptics::FalconLoopOptions options;
  options.firmware = std::move(firmware);
  options.clock = [&clock] { return clock.now(); };
  return options;
}

}  // namespace

FalconThread::FalconThread(const Clock& clock, const haptics::FalconSettings& settings,
                           haptics::FalconFirmware firmware)
    : clock_(clock),
      device_(exchange_, settings),
      loop_(exchange_, options_of(clock, std::move(firmware))),
      pulse_(clock, kSilence),
      thread_([this] { run(); }) {
  name_thread(thread_.native_handle(), "rk-falcon");
}

FalconThread::~FalconThread() {
  stop_ = true;
  loop_.stop();
  thread_.join();
}

void FalconThread::run() noexcept {
  RealTimePriority priority(kPriority, pulse_);
  while (!stop_) {
    loop_.step(kLongestWait);
    if (priority.starves_others(clock_.now())) priority.give_up();
  }
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/usb_thread.hpp"

#include <chrono>
#include <utility>

#include "reckon/peer/thread_name.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::microseconds kLongestWait{1000};
constexpr std::chrono::milliseconds kSilence{500};

haptics::UsbLoopOptions options_of(const Clock& clock) {
  haptics::UsbLoopOptions options;
  options.clock = [&clock] { return clock.now(); };
  return options;
}

}  // namespace

UsbThread::UsbThread(const Clock& clock, const haptics::DeviceLimits& limits,
                     std::unique_ptr<haptics::UsbDriver> driver)
    : clock_(clock),
      device_(exchange_, limits),
      loop_(exchange_, std::move(driver), options_of(clock)),
      pulse_(clock, kSilence),
      thread_([this] { run(); }) {
  name_thread(thread_.native_handle(), "rk-usb");
}

UsbThread::~UsbThread() {
  stop_ = true;
  loop_.stop();
  thread_.join();
}

void UsbThread::run() noexcept {
  RealTimePriority priority(kPriority, pulse_);
  while (!stop_) {
    loop_.step(kLongestWait);
    if (priority.starves_others(clock_.now())) priority.give_up();
  }
}

}  // namespace reckon::peer

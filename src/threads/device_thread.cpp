// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/device_thread.hpp"

#include <chrono>
#include <utility>

#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::milliseconds kSilence{500};

}  // namespace

DeviceThread::DeviceThread(const Clock& clock, const char* name, std::function<void()> step)
    : clock_(clock), step_(std::move(step)), pulse_(clock, kSilence), thread_([this] { run(); }) {
  name_thread(thread_.native_handle(), name);
}

DeviceThread::~DeviceThread() {
  stop_ = true;
  thread_.join();
}

void DeviceThread::run() noexcept {
  RealTimePriority priority(kPriority, pulse_);
  while (!stop_) {
    step_();
    if (priority.starves_others(clock_.now())) priority.give_up();
  }
}

}  // namespace reckon::peer

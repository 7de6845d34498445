// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A real device whose session runs in a thread of its own.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/threads/device_thread.hpp"
#include "reckon/peer/threads/real_device.hpp"

namespace reckon::peer {

/// @tparam Exchange between the servo and the thread  @tparam Device for the servo
/// @tparam Session steps in the thread, see haptics::DeviceSession
template <class Exchange, class Device, class Session>
class ThreadedDevice final : public RealDevice {
 public:
  /// @param name of the thread  @param rest arguments of the session after its exchange
  template <class... Rest>
  ThreadedDevice(const Clock& clock, const char* name, const haptics::DeviceLimits& limits,
                 Rest&&... rest)
      : device_(exchange_, limits),
        session_(exchange_, std::forward<Rest>(rest)...),
        thread_(clock, name, [this] { session_.step(DeviceThread::kLongestWait); }) {}
  ~ThreadedDevice() override { session_.stop(); }

  haptics::HapticDevice& device() noexcept override { return device_; }
  std::vector<std::string> take_notices() override { return session_.take_notices(); }
  unsigned axes() const noexcept override { return session_.axes(); }

 private:
  Exchange exchange_;
  Device device_;
  Session session_;
  DeviceThread thread_;  // uses all members before it
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/real_device.hpp"

#include <utility>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/peer/threads/device_thread.hpp"

namespace reckon::peer {
namespace {

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

using haptics::EvdevDevice, haptics::EvdevExchange, haptics::EvdevLoop;
using haptics::UsbDevice, haptics::UsbExchange, haptics::UsbLoop, haptics::SerialLoop;

haptics::DeviceSession::SteadyTime time_of(const Clock& clock) {
  return [&clock] { return clock.now(); };
}

}  // namespace

std::unique_ptr<RealDevice> usb_device(const Clock& clock, const haptics::DeviceLimits& limits,
                                       std::unique_ptr<haptics::UsbDriver> driver,
                                       haptics::UsbLoopOptions options) {
  options.clock = time_of(clock);
  return std::make_unique<ThreadedDevice<UsbExchange, UsbDevice, UsbLoop>>(
      clock, "rk-usb", limits, std::move(driver), std::move(options));
}

std::unique_ptr<RealDevice> serial_device(const Clock& clock, const haptics::DeviceLimits& limits,
                                          haptics::SerialPlace place) {
  return std::make_unique<ThreadedDevice<UsbExchange, UsbDevice, SerialLoop>>(
      clock, "rk-serial", limits, limits, std::move(place), time_of(clock));
}

std::unique_ptr<RealDevice> evdev_device(const Clock& clock, const haptics::EvdevSettings& settings,
                                         std::unique_ptr<haptics::EventCalls> calls) {
  return std::make_unique<ThreadedDevice<EvdevExchange, EvdevDevice, EvdevLoop>>(
      clock, "rk-evdev", haptics::evdev_limits(settings), settings, std::move(calls),
      time_of(clock));
}

}  // namespace reckon::peer

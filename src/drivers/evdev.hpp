// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A Linux force feedback device as a real device.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/haptics/hid/hid_events.hpp"
#include "reckon/haptics/usb/usb_list.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/threads/real_device.hpp"

namespace reckon::peer {

/// A Linux force feedback device. @param calls kernel calls @throws std::invalid_argument as
/// haptics::evdev_limits(), std::system_error if no thread can be created
[[nodiscard]] std::unique_ptr<RealDevice> evdev_device(
    const Clock& clock, const haptics::EvdevSettings& settings,
    std::unique_ptr<haptics::EventCalls> calls = haptics::force_feedback_calls());

/// Settings for the driver of such a device.
[[nodiscard]] haptics::EvdevSettings evdev_settings_of(const DeviceConfig& device);

/// @param usb USB devices: a known force feedback board that is not among `seen` is configured as
/// another kind of device
[[nodiscard]] std::vector<AttachedDevice> judge_events(
    const std::vector<haptics::EventDeviceSeen>& seen,
    const std::vector<haptics::UsbDeviceSeen>& usb);

/// USB vendor and product IDs of a device.
struct EventUsbId {
  std::uint16_t vendor = 0, product = 0;
  friend constexpr bool operator==(const EventUsbId&, const EventUsbId&) = default;
};
/// Lines of the udev rule. @param undriven HID PID devices of this host that are not event devices
/// with force feedback
[[nodiscard]] std::string evdev_udev(const std::vector<EventUsbId>& undriven);

}  // namespace reckon::peer

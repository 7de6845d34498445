// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Presents HID PID devices that the kernel does not drive as event devices, and sends their reports
// as the kernel's driver does.
#pragma once

#include <memory>
#include <vector>

#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/hid/hid_calls.hpp"

namespace reckon::haptics {

/// Devices with force feedback whose springs the kernel does not drive.
[[nodiscard]] std::vector<HidSeen> undriven_devices(HidCalls& devices);

/// The devices of `events`, followed by the undriven_devices(), with the same calls. Their paths
/// are those in /dev (/dev/hidraw0). Such a device keeps the effects of a program that was killed
/// until they end by themselves: the kernel does not erase them.
[[nodiscard]] std::unique_ptr<EventCalls> with_hid_devices(std::unique_ptr<EventCalls> events,
                                                           std::unique_ptr<HidCalls> devices);

/// The devices of the kernel: /dev/input/event0 .. and /dev/hidraw0 ..
[[nodiscard]] std::unique_ptr<EventCalls> force_feedback_calls();

}  // namespace reckon::haptics

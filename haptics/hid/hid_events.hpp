// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices of the class HID PID that the kernel does not drive as event devices, by reports of their
// own: what the kernel's driver does for the others.
#pragma once

#include <memory>
#include <vector>

#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/hid/hid_calls.hpp"

namespace reckon::haptics {

/// Devices that give forces, and whose springs the kernel does not drive.
[[nodiscard]] std::vector<HidSeen> undriven_devices(HidCalls& devices);

/// Those of `events`, and after them the undriven_devices(), which are used likewise. By its path
/// (/dev/hidraw0) each is. Such a device has the effects that it was told until it ends them:
/// nobody erases those of a program that was killed.
[[nodiscard]] std::unique_ptr<EventCalls> with_hid_devices(std::unique_ptr<EventCalls> events,
                                                           std::unique_ptr<HidCalls> devices);

/// Those of the kernel: /dev/input/event0 .., and /dev/hidraw0 ..
[[nodiscard]] std::unique_ptr<EventCalls> force_feedback_calls();

}  // namespace reckon::haptics

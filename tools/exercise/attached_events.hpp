// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What force feedback devices of Linux are attached to this host, and what is in the way.
#pragma once

#include <vector>

#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/haptics/usb/usb_list.hpp"
#include "reckon/tools/exercise/attached_devices.hpp"

namespace reckon::tools {

/// @param usb devices of USB: one that is known to give force feedback, and is not seen, is set up
/// as something else
[[nodiscard]] std::vector<AttachedDevice> judge_events(
    const std::vector<haptics::EventDeviceSeen>& seen,
    const std::vector<haptics::UsbDeviceSeen>& usb);

/// Devices of this host of the class HID PID that are no event devices with force feedback, each
/// kind once.
[[nodiscard]] std::vector<peer::UsbId> undriven_devices();

/// Looks at this host. No force is asked for.
[[nodiscard]] std::vector<AttachedDevice> look_at_events();

}  // namespace reckon::tools

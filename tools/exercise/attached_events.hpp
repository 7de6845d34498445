// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Linux force feedback devices attached to this host, and the problems that keep them from being
// used.
#pragma once

#include <vector>

#include "reckon/haptics/evdev/event_facts.hpp"
#include "reckon/haptics/usb/usb_list.hpp"
#include "reckon/tools/exercise/attached_devices.hpp"

namespace reckon::tools {

/// @param usb USB devices: a known force feedback board that is not among `seen` is configured as
/// another kind of device
[[nodiscard]] std::vector<AttachedDevice> judge_events(
    const std::vector<haptics::EventDeviceSeen>& seen,
    const std::vector<haptics::UsbDeviceSeen>& usb);

/// HID PID devices of this host that are not event devices with force feedback, each pair of USB
/// IDs once.
[[nodiscard]] std::vector<peer::UsbId> undriven_devices();

/// Scans this host. No force is requested.
[[nodiscard]] std::vector<AttachedDevice> look_at_events();

}  // namespace reckon::tools

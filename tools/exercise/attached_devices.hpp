// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Haptic devices attached to this host, and the problems that keep them from being used.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/usb/usb_list.hpp"
#include "reckon/peer/drivers/driver.hpp"

namespace reckon::tools {

using peer::AttachedDevice;

/// Result of a scan of USB.
struct UsbLook {
  std::string problem;     ///< why there is no USB here; empty: there is
  std::size_t others = 0;  ///< devices without a driver
  std::vector<AttachedDevice> devices;
};

/// The udev rule that allows the user logged in at this host to open the devices of all drivers.
/// Devices that it has to name by their IDs are those of this host.
[[nodiscard]] std::string udev_rule();
/// Name of the rule's file in kRuleFolder.
inline constexpr const char* kRuleFile = "70-reckon.rules";
inline constexpr const char* kRuleFolder = "/etc/udev/rules.d";

/// Why a driver shows no forces on the device that it has opened.
struct UsbProblem {
  std::string_view driver;  ///< its name
  std::string sentence;
};

/// Sorts USB devices into supported and other ones.
/// @param problems of devices that this user may open @param has_rule the rule is installed
[[nodiscard]] UsbLook judge_usb(const std::vector<haptics::UsbDeviceSeen>& seen,
                                std::span<const UsbProblem> problems, bool has_rule);
/// Scans this host. @param ask_them sets up devices that can be opened, without any force, until
/// they can show one, for 2 s each at most
[[nodiscard]] UsbLook look_at_usb(bool ask_them);
/// The attached devices that drivers find by themselves. Requests no force.
[[nodiscard]] std::vector<AttachedDevice> look_beside_usb();

}  // namespace reckon::tools

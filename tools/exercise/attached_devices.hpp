// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What is attached to this host that a hand could hold, and what is in the way.
#pragma once

#include <string>
#include <vector>

#include "reckon/haptics/usb/usb_list.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"

namespace reckon::tools {

/// A device that there is a driver for.
struct AttachedDevice {
  std::string driver;   ///< as --device and [[device]] have it
  std::string name;     ///< of the product, and where it is
  std::string use;      ///< how it would be used
  std::string problem;  ///< why it cannot be used now; empty: it can
  std::string remedy;   ///< of the problem
};

/// What a look at USB found.
struct UsbLook {
  std::string problem;     ///< why there is no USB here; empty: there is
  std::size_t others = 0;  ///< devices that there is no driver for
  std::vector<AttachedDevice> devices;
};

/// The rule of udev by which the person who sits at this host may open the devices.
/// @param undriven see undriven_devices(): those of this host are named one by one
[[nodiscard]] std::string udev_rule(const std::vector<peer::UsbId>& undriven);
/// Name of the rule's file in its folder.
inline constexpr const char* kRuleFile = "70-reckon.rules";
inline constexpr const char* kRuleFolder = "/etc/udev/rules.d";

/// Names of all drivers, as --device has them.
[[nodiscard]] std::string driver_names();

/// What devices of USB are for us. @param said what the drivers had to say of those that are open
/// to us @param has_rule the rule is installed
[[nodiscard]] UsbLook judge_usb(const std::vector<haptics::UsbDeviceSeen>& seen,
                                const std::vector<std::string>& said, bool has_rule);
/// Looks at this host. @param ask_them whether devices that can be opened are set up without any
/// force and asked, for 2 s each at most
[[nodiscard]] UsbLook look_at_usb(bool ask_them);

}  // namespace reckon::tools

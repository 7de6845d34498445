// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lists the devices attached to USB, and which of them this user may open.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "reckon/haptics/usb/usb_line.hpp"

namespace reckon::haptics {

/// An attached device.
struct UsbDeviceSeen {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0, address = 0;
  bool is_open_to_us = false;
  bool is_denied = false;  ///< this user lacks the permission
  std::string problem;     ///< libusb's reason why it cannot be opened
};

/// All devices with readable descriptors. Devices that `is_ours` selects are opened briefly; none
/// is claimed.
[[nodiscard]] std::vector<UsbDeviceSeen> usb_devices(
    UsbContext& context, const std::function<bool(const UsbDeviceSeen&)>& is_ours);

}  // namespace reckon::haptics

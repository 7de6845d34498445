// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which devices are attached to USB, and which of them this user may open.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "reckon/haptics/usb/usb_line.hpp"

namespace reckon::haptics {

/// One device.
struct UsbDeviceSeen {
  std::uint16_t vendor = 0, product = 0;
  int bus = 0, address = 0;
  bool is_open_to_us = false;
  bool is_denied = false;  ///< this user lacks the right
  std::string problem;     ///< the library's reason, where it is not open to us
};

/// All devices whose descriptors can be read; only those that `is_ours` says are opened, for a
/// moment, and none is claimed.
[[nodiscard]] std::vector<UsbDeviceSeen> usb_devices(
    UsbContext& context, const std::function<bool(const UsbDeviceSeen&)>& is_ours);

}  // namespace reckon::haptics

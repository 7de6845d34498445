// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How many handles and transfers of libusb the program has. The linker leads its calls here first
// (--wrap); each goes on to the library.
#pragma once

#include <atomic>

namespace reckon::fuzz::unplugs {

struct UsbCount {
  std::atomic<int> handles = 0, transfers = 0;
};
/// What is there now. Any thread.
[[nodiscard]] const UsbCount& counted_usb() noexcept;
[[nodiscard]] bool is_usb_given_back() noexcept;

}  // namespace reckon::fuzz::unplugs

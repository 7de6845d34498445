// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The number of libusb handles and transfers of the program. The linker redirects the calls here
// first (--wrap); each continues to the library.
#pragma once

#include <atomic>

namespace reckon::fuzz::unplugs {

struct UsbCount {
  std::atomic<int> handles = 0, transfers = 0;
};
/// The current counts. Any thread.
[[nodiscard]] const UsbCount& counted_usb() noexcept;
[[nodiscard]] bool is_usb_given_back() noexcept;

}  // namespace reckon::fuzz::unplugs

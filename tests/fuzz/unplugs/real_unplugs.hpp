// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Unplugs in real time: the threads of a peer, the real libusb over a model that another thread
// pulls out, a serial board behind a real tty. Durations are printed; they depend on the host.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/unplugs/plan.hpp"

namespace reckon::fuzz::unplugs {

struct RealOutcome {
  unsigned rounds = 0;                  ///< successful rounds
  std::chrono::nanoseconds longest{0};  ///< from an unplug until the servo reads nothing
  unsigned late = 0;                    ///< of them after more than 10 ms
  std::string problem;                  ///< the violation; empty: none
};

/// Where the library finds a device by itself.
struct UsbSite {
  std::string node;  ///< the end of its device file's name
  std::function<void(const std::vector<std::uint8_t>& descriptors)> add;
  std::function<void()> remove;
};

/// Pulls the device out `rounds` times, at random instants while forces are shown. @param site
/// without one the library is given the device
[[nodiscard]] RealOutcome unplug_usb(DeviceKind device, unsigned rounds, unsigned seed,
                                     const UsbSite* site = nullptr);
[[nodiscard]] RealOutcome unplug_board(unsigned rounds, unsigned seed);

}  // namespace reckon::fuzz::unplugs

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A board on a serial port as a real device.
#pragma once

#include <memory>

#include "reckon/haptics/serial/serial_loop.hpp"
#include "reckon/peer/threads/real_device.hpp"

namespace reckon::peer {

/// A board on a serial port. @param limits see haptics::usb_limits()
/// @throws std::system_error if no thread can be created
[[nodiscard]] std::unique_ptr<RealDevice> serial_device(const Clock& clock,
                                                        const haptics::DeviceLimits& limits,
                                                        haptics::SerialPlace place);

}  // namespace reckon::peer

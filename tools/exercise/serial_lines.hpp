// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Serial lines of this host that a board may be on, and what is in the way.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/tools/exercise/attached_devices.hpp"

namespace reckon::tools {

/// Where lines have names that stay when they are plugged in elsewhere.
inline constexpr const char* kSerialFolder = "/dev/serial/by-id";

/// Of each line of `folder`: what is in the way of a board on it. None is opened, for that resets
/// many boards, and what else is on a line is none of our business. Cost: reads what all processes
/// of this user have open.
[[nodiscard]] std::vector<AttachedDevice> look_at_serial_lines(
    const std::filesystem::path& folder = kSerialFolder);

}  // namespace reckon::tools

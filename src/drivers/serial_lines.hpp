// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Serial ports of this host to which a board may be connected, and the problems that block their
// use.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reckon/peer/drivers/driver.hpp"

namespace reckon::peer {

/// Folder with port names that do not depend on the socket.
inline constexpr const char* kSerialFolder = "/dev/serial/by-id";

/// Checks each port of `folder` for problems. Opens none: that would reset many boards, and other
/// devices on serial ports must not be disturbed. Cost: reads the open files of all processes of
/// this user.
[[nodiscard]] std::vector<AttachedDevice> look_at_serial_lines(
    const std::filesystem::path& folder = kSerialFolder);

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Short text messages of the viewer's server.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::tools {

/// A line of the log. @param level "info" or "warning"
[[nodiscard]] std::string note_message(std::string_view level, std::string_view text);
/// Assigns a hand to a tab.
[[nodiscard]] std::string hand_message(std::optional<std::uint16_t> hand, std::string_view text);
/// Sent last on a connection.
[[nodiscard]] std::string bye_message(std::string_view text);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The short text messages of the viewer's server that say one thing each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::tools {

/// A line of the log. @param level "info" or "warning"
[[nodiscard]] std::string note_message(std::string_view level, std::string_view text);
/// Which hand a tab has.
[[nodiscard]] std::string hand_message(std::optional<std::uint16_t> hand, std::string_view text);
/// The last one of a connection.
[[nodiscard]] std::string bye_message(std::string_view text);

}  // namespace reckon::tools

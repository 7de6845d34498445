// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Durations as users write and read them: "10s", "5 ms", "1.5 min".
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Reads a number and its unit (ns, us, ms, s, min, h), as scene files do; a number without a unit
/// is in seconds. No value for a negative or non-finite number, one beyond 292 years, or any other
/// text.
[[nodiscard]] std::optional<std::chrono::nanoseconds> parse_duration(std::string_view text);

/// Short text of at most 4 digits and a unit, or two units: "5 ms", "1.25 s", "3 min 20 s", "2 h 5
/// min".
[[nodiscard]] std::string duration_text(std::chrono::nanoseconds duration);

}  // namespace reckon::tools

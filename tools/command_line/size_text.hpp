// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sizes in octets as users write and read them: "500k", "100 MB", "2GiB".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Reads a number and its unit: none or B, k, M, G (powers of 1000, with or without a B), or KiB,
/// MiB, GiB. No value for other text, for zero, and above 2^53.
[[nodiscard]] std::optional<std::uint64_t> parse_size(std::string_view text);

/// Short text of at most 4 digits: "512 B", "1.25 MB".
[[nodiscard]] std::string size_text(std::uint64_t octets);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets as text (RFC 4648 section 4).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace reckon::tools {

inline constexpr std::string_view kBase64Letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Padded with `=` to a multiple of 4 characters.
[[nodiscard]] std::string base64(std::span<const std::byte> octets);

}  // namespace reckon::tools

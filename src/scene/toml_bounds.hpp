// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits of a TOML text, checked before it is parsed: toml++ and the readers of its tables recurse
// once per level, and a part of a dotted key of two letters takes 200 octets.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace reckon::peer {

/// Limit of octets of a scene file or a device descriptor.
inline constexpr std::size_t kMostTomlOctets = 16 << 20;
/// Limit of nested tables and arrays. Each part of a key or a header counts as one level.
inline constexpr std::size_t kMostTomlLevels = 256;
/// Limit of keys, parts of keys, and elements of arrays.
inline constexpr std::size_t kMostTomlValues = 300'000;

/// Scans the text once, with memory only for its levels. An invalid TOML text may pass; the parser
/// then refuses it before it reads beyond the scanned part.
/// @throws SceneFileError at the place where a bound is exceeded, with the remedy
void check_text_bounds(std::string_view text, const std::string& file);

}  // namespace reckon::peer

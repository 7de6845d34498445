// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bounds of a TOML text, checked before it is parsed: toml++ and what reads its tables recurse once
// for each level, and a part of a dotted key of two letters takes 200 octets.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace reckon::peer {

/// Octets of a scene file or a device descriptor.
inline constexpr std::size_t kMostTomlOctets = 16 << 20;
/// Tables and arrays within each other. Each part of a key or a header is one.
inline constexpr std::size_t kMostTomlLevels = 256;
/// Keys, parts of keys, and elements of arrays.
inline constexpr std::size_t kMostTomlValues = 300'000;

/// Looks at the text once, without memory for more than its levels. A text that is no TOML may
/// pass; the parser then refuses it before anything that was not looked at.
/// @throws SceneFileError at the place where a bound is exceeded, with the remedy
void check_text_bounds(std::string_view text, const std::string& file);

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of beacons, by which peers find the cell of an entity anywhere.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::peer {

/// Limit of beacons that one peer follows, and longest name of a beacon.
inline constexpr std::size_t kMostFollowed = 16, kLongestBeacon = 31;

/// Whether a beacon may have this name: 1 to kLongestBeacon ASCII letters, digits, '-', '_', '.'.
[[nodiscard]] bool is_beacon_name(std::string_view name) noexcept;

/// The names in a list such as "gate, ferry"; none if it is empty.
/// @throws std::invalid_argument with the name and the remedy, for an invalid or repeated name, and
/// for more than kMostFollowed.
[[nodiscard]] std::vector<std::string> beacon_names(std::string_view list);

}  // namespace reckon::peer

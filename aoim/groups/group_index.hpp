// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Number of a multicast group within a scene: the address is the scene's base address plus this.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace reckon::aoim {

/// 0 is the base group (presence, and everything in an interop scene); 1 .. G are the pool of
/// cells. After them follow the groups of the scene's other recipient tiers, G each.
struct GroupIndex {
  std::uint16_t value = 0;
  auto operator<=>(const GroupIndex&) const = default;
};

/// The group that every peer of a scene joins.
inline constexpr GroupIndex kBaseGroup{0};

/// Default number of cell groups of a scene.
inline constexpr std::size_t kDefaultPool = 256;

/// Most cell groups a scene may ask for: switches of a LAN keep about 1,000 groups before they
/// flood.
inline constexpr std::size_t kMaximumPool = 1000;

/// Whether cells can use this number of groups: with 2 or 3 a cell would share its group with a
/// neighbour.
[[nodiscard]] constexpr bool is_pool(std::size_t groups) noexcept {
  return groups == 1 || (groups >= 4 && groups <= kMaximumPool);
}

/// The remedy for an invalid pool.
inline constexpr std::string_view kPoolRemedy =
    "take 4 to 1000, or 1 for a world that is not divided";

}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner of an object, with a version that orders all owners it ever has.
#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>

namespace reckon::peer {

/// Objects with a changeable owner, at most.
inline constexpr std::size_t kMostOwnable = 256;
using ObjectSet = std::bitset<kMostOwnable>;

/// The upper half of a version is the number of the last act that gave the object away (act.hpp),
/// the lower half counts the hand-overs since.
struct Tenure {
  std::uint64_t version = 0;
  std::uint32_t owner = 0;  ///< epoch; 0: nobody

  friend constexpr bool operator==(const Tenure&, const Tenure&) = default;
};

/// Reasons of a change of owner.
enum class OwnerChange : std::uint8_t {
  founded,   ///< the first owner
  granted,   ///< by the former owner
  adopted,   ///< the former owner has failed or left
  returned,  ///< a grant was refused
  alone,     ///< Ownership::go_alone()
  merged,    ///< an older world has replaced ours
};

/// How the owner of this version got the object, as all peers can tell: founded, granted or
/// adopted.
[[nodiscard]] constexpr OwnerChange cause_of(std::uint64_t version) noexcept {
  if (static_cast<std::uint32_t>(version) != 0) return OwnerChange::granted;
  return version >> 32 <= 1 ? OwnerChange::founded : OwnerChange::adopted;
}

/// A count of hand-overs from here on is refused, so that no version overflows into the act.
inline constexpr std::uint32_t kMostHandOvers = 1U << 31;

[[nodiscard]] constexpr std::uint64_t version_of(std::uint32_t act, std::uint32_t count) noexcept {
  return std::uint64_t{act} << 32 | count;
}
[[nodiscard]] constexpr std::uint32_t act_of(std::uint64_t version) noexcept {
  return static_cast<std::uint32_t>(version >> 32);
}
[[nodiscard]] constexpr std::uint32_t count_of(std::uint64_t version) noexcept {
  return static_cast<std::uint32_t>(version);
}

/// Whether `a` replaces `b`. With equal versions, an object that was released replaces its owner.
[[nodiscard]] constexpr bool is_newer(const Tenure& a, const Tenure& b) noexcept {
  if (a.version != b.version) return a.version > b.version;
  return a.owner == 0 && b.owner != 0;
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Why a remote entity is no longer among those that a peer shows.
#pragma once

#include <cstdint>
#include <string_view>

namespace reckon::peer {

/// What ended it here. Where it may go on elsewhere, it can be discovered again.
enum class Removal : std::uint8_t {
  deactivated,    ///< its owner has ended it
  owner_left,     ///< its peer has left the exercise
  owner_changed,  ///< its ID is another's now, or its owner has started again
  out_of_sight,   ///< it is beyond the radius of interest, by its movement or ours
  silent,         ///< nothing was heard of it, or of its peer, for its time-out
  no_room         ///< the table is full, and another has its row
};

/// "out of sight".
[[nodiscard]] constexpr std::string_view name(Removal cause) noexcept {
  switch (cause) {
    case Removal::deactivated:
      return "deactivated";
    case Removal::owner_left:
      return "owner left";
    case Removal::owner_changed:
      return "owner changed";
    case Removal::out_of_sight:
      return "out of sight";
    case Removal::silent:
      return "silent";
    case Removal::no_room:
      return "no room";
  }
  return "";
}

}  // namespace reckon::peer

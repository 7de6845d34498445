// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The reason why this peer no longer shows a remote entity.
#pragma once

#include <cstdint>
#include <string_view>

namespace reckon::peer {

/// The cause of the end here. If the entity continues elsewhere, it can be discovered again.
enum class Removal : std::uint8_t {
  deactivated,    ///< its owner has ended it
  owner_left,     ///< its peer has left the exercise
  owner_changed,  ///< its ID belongs to another now, or its owner has started again
  out_of_sight,   ///< it is beyond the radius of interest, by its movement or ours
  silent,         ///< neither it nor its peer was received for its time-out
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

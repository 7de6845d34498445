// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An act changes the voters of a scene and gives away the objects of failed owners. Acts have
// numbers. A majority of the voters before and after an act decides it.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/ownership/roll.hpp"
#include "reckon/peer/ownership/tenure.hpp"

namespace reckon::peer {

/// Identity of a world: all peers that agree on one chain of acts. An older world has precedence.
struct WorldId {
  std::uint32_t founded = 0;  ///< [s], UTC since 1970
  std::uint32_t founder = 0;  ///< epoch; 0: none

  friend constexpr auto operator<=>(const WorldId&, const WorldId&) = default;
  [[nodiscard]] constexpr bool exists() const noexcept { return founder != 0; }
};

/// The content of an act.
struct Act {
  std::uint32_t number = 0;  ///< from 1; 0: none
  std::uint32_t chair = 0;   ///< epoch of the voter who proposes acts, and gets the objects
  Roll roll;                 ///< voters from now on
  ObjectSet given;           ///< objects that the chair owns from now on, as version (number, 0)
  std::array<std::uint32_t, Roll::kMost> removed_epochs{};
  std::size_t removed_count = 0;

  /// Voters of the last act that are not voters any more.
  [[nodiscard]] std::span<const std::uint32_t> removed() const noexcept {
    return std::span(removed_epochs).first(removed_count);
  }
  [[nodiscard]] bool removes(std::uint32_t epoch) const noexcept;
  /// False if there is no room.
  bool remove(std::uint32_t epoch) noexcept;
  /// Of everything that voters must agree on.
  [[nodiscard]] std::uint32_t hash() const noexcept;
};

/// Order of the proposals of one act: attempts, and among equal attempts the proposer's epoch.
struct Ballot {
  std::uint32_t attempt = 0;
  std::uint32_t proposer = 0;  ///< epoch

  friend constexpr auto operator<=>(const Ballot&, const Ballot&) = default;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks the leaders of cells: succession, hosts that slept, rivals, member counts. Part of Watch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/leaders/place.hpp"

namespace reckon::fuzz::leaders {

class LeadWatch {
 public:
  using Sentence = std::optional<std::string>;

  /// Call it after each action of a host: joins, leaves and changes of leaders are then seen as
  /// they happen, however short they are.
  void note(const Place& place, nanoseconds now);
  /// L10: a host that ranks behind a leader does not unseat it.
  [[nodiscard]] const Sentence& newcomers_stay_behind() const noexcept { return unseated_; }
  /// L11: a host that has slept longer than a leader may be silent does not lead beside another
  /// one.
  [[nodiscard]] static Sentence sleepers_ask(const std::vector<Place>& places, nanoseconds now);
  /// L12: no cell has two leaders, not even for an instant.
  [[nodiscard]] static Sentence never_two(const std::vector<Place>& places);
  /// L13: no host counts more members of a cell than are in it, or were at the last check.
  [[nodiscard]] Sentence members_counted(const std::vector<Place>& places);

 private:
  /// What one life has seen of one cell since it last entered it. It is kept after a leave or
  /// death, because datagrams of it are still on their way.
  struct Stay {
    bool lasts = true;        ///< it is in the cell
    std::uint32_t first = 0;  ///< first leader that it named; 0: none yet
    nanoseconds first_at{};
    std::uint32_t last = 0;  ///< leader that it names now
    nanoseconds since{};     ///< since when it names it
  };
  void note(const Place& place, aoim::CellId cell, std::uint32_t leader, nanoseconds now);
  using Life = std::uint32_t;

  std::map<Life, std::map<aoim::CellId, Stay>> stays_;
  Sentence unseated_;
  std::map<aoim::CellId, std::size_t> inside_;  ///< members at the last check
};

}  // namespace reckon::fuzz::leaders

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Looks at who leads cells: places behind leaders, sleepers, rivals, members. Part of Watch.
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

  /// To be called after all that a host does: joins, leaves and changes of leaders are seen as they
  /// happen, however short a stay or an absence is.
  void note(const Place& place, nanoseconds now);
  /// L10: who has taken its place behind a leader does not unseat it.
  [[nodiscard]] const Sentence& newcomers_stay_behind() const noexcept { return unseated_; }
  /// L11: who has slept for longer than a leader may be silent does not lead beside another one.
  [[nodiscard]] static Sentence sleepers_ask(const std::vector<Place>& places, nanoseconds now);
  /// L12: no cell has two leaders, not even for an instant.
  [[nodiscard]] static Sentence never_two(const std::vector<Place>& places);
  /// L13: nobody counts more members of a cell than are in it, or were at the last look.
  [[nodiscard]] Sentence members_counted(const std::vector<Place>& places);

 private:
  /// What one life has seen of one cell since it entered it last; kept when it leaves or dies, for
  /// what it said is still on its way.
  struct Stay {
    bool lasts = true;        ///< it is in the cell
    std::uint32_t first = 0;  ///< leader that it named first; 0: none yet
    nanoseconds first_at{};
    std::uint32_t last = 0;  ///< leader that it names
    nanoseconds since{};     ///< and since when
  };
  void note(const Place& place, aoim::CellId cell, std::uint32_t leader, nanoseconds now);
  using Life = std::uint32_t;

  std::map<Life, std::map<aoim::CellId, Stay>> stays_;
  Sentence unseated_;
  std::map<aoim::CellId, std::size_t> inside_;  ///< at the last look
};

}  // namespace reckon::fuzz::leaders

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Looks at who leads cells: places behind leaders, sleepers, rivals, members. Part of Watch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/leaders/place.hpp"

namespace reckon::fuzz::leaders {

class LeadWatch {
 public:
  using Sentence = std::optional<std::string>;

  /// L10: who has taken its place behind a leader does not unseat it.
  [[nodiscard]] Sentence newcomers_stay_behind(const std::vector<Place>& places, nanoseconds now);
  /// L11: who has slept for longer than a leader may be silent does not lead beside another one.
  [[nodiscard]] static Sentence sleepers_ask(const std::vector<Place>& places, nanoseconds now);
  /// L12: no cell has two leaders, not even for an instant.
  [[nodiscard]] static Sentence never_two(const std::vector<Place>& places);
  /// L13: nobody counts more members of a cell than are in it, or were at the last look.
  [[nodiscard]] Sentence members_counted(const std::vector<Place>& places);

 private:
  /// What one life has seen of one cell that it is in.
  struct Seen {
    std::uint32_t first = 0, last = 0;  ///< leaders that it named
    nanoseconds since{};                ///< the last one has been named since then
    nanoseconds first_at{};
  };
  using Key = std::pair<aoim::CellId, std::uint32_t>;  ///< cell, life

  std::map<Key, Seen> seen_;
  std::map<aoim::CellId, std::size_t> inside_;  ///< at the last look
};

}  // namespace reckon::fuzz::leaders

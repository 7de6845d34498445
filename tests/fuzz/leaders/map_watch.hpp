// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks group maps: leases, quarantines, merges. Part of Watch.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "reckon/tests/fuzz/leaders/place.hpp"

namespace reckon::fuzz::leaders {

class MapWatch {
 public:
  using Sentence = std::optional<std::string>;

  explicit MapWatch(nanoseconds calm) : calm_(calm) {}

  /// L14: hosts use maps of leaders only, and a leader observes the quarantine.
  [[nodiscard]] static Sentence kept(const std::vector<Place>& places);
  /// L15: a host that has received no map for the lease uses none of its groups.
  [[nodiscard]] static Sentence leases_end(const std::vector<Place>& places, nanoseconds now);
  /// L16: a group that two leaders had given to two cells when the calm began, or that one had
  /// given and the other had in quarantine, belongs to no cell from 3 s on, until its quarantine is
  /// over.
  [[nodiscard]] Sentence merged(const std::vector<Place>& places, nanoseconds now);
  /// L20: a group that a leader had given to a cell of its own when the calm began, and that no
  /// other host used or had in quarantine, stays with that cell while the leader leads.
  [[nodiscard]] Sentence nothing_lost(const std::vector<Place>& places, nanoseconds now);

 private:
  /// A group that only its leader has given away.
  struct Own {
    std::uint32_t leader = 0;
    aoim::CellId cell;
    aoim::GroupIndex group;
  };
  [[nodiscard]] static std::set<std::uint16_t> contested(const std::vector<Place>& places,
                                                         nanoseconds now);
  [[nodiscard]] static std::vector<Own> own_groups(const std::vector<Place>& places,
                                                   nanoseconds now);

  nanoseconds calm_;
  std::optional<std::vector<Own>> own_;               ///< when the calm began
  std::optional<std::set<std::uint16_t>> contested_;  ///< when the calm began
};

}  // namespace reckon::fuzz::leaders

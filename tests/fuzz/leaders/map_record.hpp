// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Record of a host and its group maps: the leader whose map it used, when the last map arrived, its
// map when it began to lead the scene, and how soon it gave a group to another cell.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "reckon/aoim/leader/leader_role.hpp"
#include "reckon/tests/fuzz/leaders/plan.hpp"

namespace reckon::fuzz::leaders {

class MapRecord {
 public:
  explicit MapRecord(std::size_t pool) : given_(pool + 1), inherited_(pool + 1) {}

  /// Call it before and after each action of a host.
  void look(const aoim::LeaderRole& role, nanoseconds now);
  /// A used datagram contained a map; it arrived at `came`.
  void hear(nanoseconds came) noexcept { heard_ = std::max(heard_, came); }

  /// The first violation of the host; none if there is none.
  [[nodiscard]] const std::optional<std::string>& fault() const noexcept { return fault_; }
  /// When the last map arrived, or when it last led the scene.
  [[nodiscard]] nanoseconds heard() const noexcept { return heard_; }

 private:
  /// A group of the host's own map.
  struct Given {
    std::optional<aoim::CellId> cell;  ///< the last cell that had it
    bool used = false;
    nanoseconds idle_since{};
  };
  void note_given(const aoim::LeaderRole& role, nanoseconds now);
  void blame(std::string sentence);

  std::vector<Given> given_;     ///< by group, while it leads the scene
  std::vector<bool> inherited_;  ///< by group: in the map it held when it began to lead
  bool leads_ = false;
  bool had_map_ = false;  ///< it had a map when it began to lead
  nanoseconds began_{}, heard_{};
  std::uint32_t named_ = 0;     ///< leader of the scene that it names
  std::uint32_t believed_ = 0;  ///< leader whose map it has
  std::optional<std::uint32_t> version_;
  std::uint32_t said_ = 0;  ///< highest version of its own maps
  std::optional<std::string> fault_;
};

}  // namespace reckon::fuzz::leaders

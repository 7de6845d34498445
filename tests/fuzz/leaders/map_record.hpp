// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a host did with maps of groups: whose it believed, when it heard the last one, what it held
// when it began to lead the scene, and how soon it gave a group to another cell.
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

  /// Called before and after all that a host does.
  void look(const aoim::LeaderRole& role, nanoseconds now);
  /// A map was in a datagram that was used, and that arrived then.
  void hear(nanoseconds came) noexcept { heard_ = std::max(heard_, came); }

  /// What is wrong with what the host has done; none where nothing is.
  [[nodiscard]] const std::optional<std::string>& fault() const noexcept { return fault_; }
  /// When the last map arrived, or it led the scene.
  [[nodiscard]] nanoseconds heard() const noexcept { return heard_; }

 private:
  /// A group of the own map.
  struct Given {
    std::optional<aoim::CellId> cell;  ///< the last one that had it
    bool used = false;
    nanoseconds idle_since{};
  };
  void note_given(const aoim::LeaderRole& role, nanoseconds now);
  void blame(std::string sentence);

  std::vector<Given> given_;     ///< by group, while it leads the scene
  std::vector<bool> inherited_;  ///< by group: in the map that it held when it began to lead
  bool leads_ = false;
  bool had_map_ = false;  ///< when it began to lead
  nanoseconds began_{}, heard_{};
  std::uint32_t named_ = 0;     ///< leader of the scene
  std::uint32_t believed_ = 0;  ///< whose map it has
  std::optional<std::uint32_t> version_;
  std::uint32_t said_ = 0;  ///< highest version of its own
  std::optional<std::string> fault_;
};

}  // namespace reckon::fuzz::leaders

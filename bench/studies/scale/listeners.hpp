// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How many light peers listen to each group, and which of them are witnesses.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/bench/studies/scale/setting.hpp"
#include "reckon/bench/studies/scale/witnesses.hpp"

namespace reckon::bench {

/// One thread. Times [s] since the start.
class Listeners {
 public:
  /// @param near_rows that have groups  @param witnesses outlives this
  Listeners(const ScaleSetting& setting, std::size_t near_rows, Witnesses& witnesses);

  /// A peer hears a group from `from` on.
  void join(std::uint32_t peer, aoim::GroupIndex group, double from);
  /// @param pool that the group is of
  void leave(std::uint32_t peer, aoim::GroupIndex group, std::size_t pool);
  /// Joins that are in force by `time`.
  void arrive(double time);

  [[nodiscard]] std::uint64_t of(aoim::GroupIndex group) const noexcept {
    return count_[group.value];
  }
  /// That somebody listens to, without the base group.
  [[nodiscard]] std::uint64_t groups() const noexcept;

 private:
  struct Pending {
    double from;
    aoim::GroupIndex group;
  };
  std::vector<std::uint32_t> count_;  // by group
  std::vector<Pending> joining_;
  Witnesses& witnesses_;
};

}  // namespace reckon::bench

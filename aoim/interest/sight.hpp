// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which remote entities are of interest: by distance, and by the cells that this peer listens to.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/interest/interest.hpp"
#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// A beacon that we follow.
struct FollowedBeacon {
  std::uint32_t tag = 0;
  bool found = false;  ///< in the map of groups; else `cell` is where it was last
  CellId cell;         ///< of the tile at the origin: its number is what counts
  GroupIndex group;    ///< in which its cell is spoken in; the base group where it has none
  GroupIndex number;   ///< of its cell in the subscription; 0: we do not listen to it
  std::chrono::nanoseconds until{};  ///< and where it is not found, for how long still
};

/// The exact test of Interest, and what cells add to it: the cell of a beacon that we follow is
/// within, a locale that we do not listen to is hidden. One thread; allocates at construction
/// alone.
class Sight {
 public:
  /// @param cells, subscription outlive this; groups are numbered as in both
  /// @param follow tags of beacons  @param finest side of the smallest cell [m]
  Sight(const InterestConfig& config, const CellPartition& cells, const Subscription& subscription,
        std::span<const std::uint32_t> follow, double finest);

  /// Judges one remote entity; see Interest::judge. Ask again as its predicted position moves.
  /// Where there are locales, one in a locale that we do not listen to is hidden.
  InterestVerdict judge(const Position& position, double nimbus, std::uint8_t kind,
                        bool shown) noexcept {
    if (is_walled_off(position)) return interest_.judge_hidden();
    return interest_.judge(position, nimbus, kind, shown, is_followed(position, shown));
  }
  /// See Interest::gap; the same holds, and it is 0 in the cell of a beacon that we follow.
  [[nodiscard]] double gap(const Position& position, double nimbus) const noexcept {
    if (is_followed(position, false)) return 0.0;
    const double away = interest_.gap(position, nimbus);
    return away <= 0.0 && is_walled_off(position) ? Interest::kHiddenGap : away;
  }
  /// See Interest::withdrawn; it leaps where a locale or the cell of a beacon is left.
  [[nodiscard]] double withdrawn() const noexcept { return interest_.withdrawn() + leapt_; }
  /// See Interest::spare; 0 in a locale that we do not listen to.
  [[nodiscard]] double spare(const Position& position, double nimbus, std::uint8_t kind) noexcept {
    if (is_walled_off(position)) return 0.0;
    return interest_.spare(position, nimbus, kind, is_followed(position, true));
  }
  /// See Interest::take_nearest_outside.
  double take_nearest_outside() noexcept { return interest_.take_nearest_outside(); }
  [[nodiscard]] const Interest& interest() const noexcept { return interest_; }

  /// Where this peer senses from now on.
  void set_foci(std::span<const Focus> foci) noexcept { interest_.set_foci(foci); }
  /// A locale is not listened to any more: what is shown in it is judged anew.
  void leave_locale() noexcept {
    if (cells_.as<LocaleMap>() != nullptr) leap();
  }

  /// Beacons that we follow, as of the last follow().
  [[nodiscard]] std::span<const FollowedBeacon> followed() const noexcept { return followed_; }
  /// Looks for each of them: `find(tag)` gives where a map of groups has it, a pdu::CellGroup-like
  /// row with column, row and group, or none. One that is not found is listened to where it was
  /// last, for so long: its owner may have been unheard, or the map.
  /// @return numbers of the cells in which they are
  template <typename Find>
  std::span<const GroupIndex> follow(std::chrono::nanoseconds now,
                                     std::chrono::nanoseconds missed_for, Find&& find) {
    besides_.clear();
    for (FollowedBeacon& one : followed_) {
      const auto row = find(one.tag);
      const GroupIndex former = one.number;
      one.found = row.has_value();
      if (row) {
        one.number = cells_.group(CellId{row->column, row->row});
        one.cell = cells_.cell_of(one.number);
        one.group = {row->group};
        one.until = now + missed_for;
      } else if (now >= one.until) {
        one.number = {};
      }
      if (former.value > 0 && one.number != former) leap();
      if (one.number.value > 0) besides_.push_back(one.number);
    }
    return besides_;
  }

 private:
  [[nodiscard]] bool is_followed(const Position& position, bool shown) const noexcept {
    return !followed_.empty() && is_in_followed_cell(position, shown);
  }
  [[nodiscard]] bool is_in_followed_cell(const Position& position, bool shown) const noexcept;
  [[nodiscard]] bool is_walled_off(const Position& position) const noexcept {
    return cells_.as<LocaleMap>() != nullptr && is_finite(position) &&
           !subscription_.is_joined(cells_.group(position));
  }
  void leap() noexcept { leapt_ += 2.0 * Interest::kFarthest; }

  const CellPartition& cells_;
  const Subscription& subscription_;
  Interest interest_;
  double finest_;
  double leapt_ = 0.0;  // [m], see withdrawn()
  std::vector<FollowedBeacon> followed_;
  std::vector<GroupIndex> besides_;  // numbers of their cells
};

}  // namespace reckon::aoim

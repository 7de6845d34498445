// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Selects remote entities of interest: by distance, and by the cells that this peer listens to.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/interest/interest.hpp"
#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// A beacon that we follow.
struct FollowedBeacon {
  std::uint32_t tag = 0;
  bool found = false;                ///< in the map of groups; else `cell` is its last cell
  CellId cell;                       ///< of the tile at the origin; its number counts
  GroupIndex group;                  ///< used for its cell's traffic; the base group if it has none
  GroupIndex number;                 ///< of its cell in the subscription; 0: not subscribed
  std::chrono::nanoseconds until{};  ///< if it is not found, end of the subscription
};

/// The exact test of Interest with the rules of cells: the cell of a followed beacon is inside, and
/// a locale without a subscription is hidden, as is any cell without one under a cut. One thread;
/// allocates only at construction.
class Sight {
 public:
  /// @param cells, subscription outlive this; groups are numbered as in both
  /// @param follow tags of beacons  @param finest side of the smallest cell [m]
  /// @param receives_all plain DIS: without cells
  Sight(const InterestConfig& config, const CellPartition& cells, const Subscription& subscription,
        std::span<const std::uint32_t> follow, double finest, bool receives_all = false)
      : cells_(cells),
        subscription_(subscription),
        interest_(config),
        finest_(finest),
        receives_all_(receives_all) {
    for (const std::uint32_t tag : follow) followed_.push_back({tag, false, {}, {}, {}, {}});
    besides_.reserve(followed_.size());
  }

  /// Judges one remote entity; see Interest::judge. Ask again as its predicted position moves. With
  /// locales or a cut, an entity in a cell without a subscription is hidden.
  InterestVerdict judge(const Position& position, double nimbus, std::uint8_t kind,
                        bool shown) noexcept {
    if (is_walled_off(position)) return interest_.judge_hidden();
    const bool wanted = is_followed(position, shown ? kLingers : kBorder);
    return interest_.judge(position, nimbus, kind, shown, wanted);
  }
  /// A shown entity, to be judged again.
  struct Shown {
    Position predicted;
    Position stated;               ///< its position in its last update
    std::chrono::nanoseconds age;  ///< time since then
    double nimbus;                 ///< [m]
    std::uint8_t kind;
  };
  /// Judges it; see Interest::spare. On the very border it is `least`.
  double check(const Shown& one, double least) noexcept {
    const bool kept = keeps(one.predicted, one.stated, one.age);
    const bool walled = is_walled_off(one.predicted);
    const double spare = walled ? 0.0 : interest_.spare(one.predicted, one.nimbus, one.kind, kept);
    if (spare > 0.0) return spare;
    // These count entities that leave.
    if (walled)
      interest_.judge_hidden();
    else if (is_accepted(interest_.judge(one.predicted, one.nimbus, one.kind, true, kept)))
      return least;
    return 0.0;
  }
  /// Whether the cell of a followed beacon keeps a shown entity in sight. Its owner sends an update
  /// in the cell that it leaves, and no more after that: `stated` is in another cell then. If the
  /// beacon has moved with it, the map of groups follows within kLingersFor.
  [[nodiscard]] bool keeps(const Position& predicted, const Position& stated,
                           std::chrono::nanoseconds age) const noexcept {
    return is_followed(predicted, kLingers) && (age < kLingersFor || is_followed(stated, kBorder));
  }
  static constexpr std::chrono::seconds kLingersFor{2};
  /// Whether the updates of the cell at this position have been received without a gap since this
  /// time.
  [[nodiscard]] bool has_received_since(const Position& position,
                                        std::chrono::nanoseconds time) const noexcept {
    return receives_all_ || subscription_.is_joined_since(cells_.group(position), time);
  }
  /// As Interest::gap. It has no exception for the cell of a followed beacon, because the position
  /// of an entity that was received elsewhere can be old: the leader of the cell introduces it.
  [[nodiscard]] double gap(const Position& position, double nimbus) const noexcept {
    const double away = interest_.gap(position, nimbus);
    return away <= 0.0 && is_walled_off(position) ? Interest::kHiddenGap : away;
  }
  /// See Interest::withdrawn; it jumps when a locale or the cell of a beacon is left.
  [[nodiscard]] double withdrawn() const noexcept { return interest_.withdrawn() + leapt_; }
  /// See Interest::take_nearest_outside.
  double take_nearest_outside() noexcept { return interest_.take_nearest_outside(); }
  [[nodiscard]] const Interest& interest() const noexcept { return interest_; }

  /// Sets the places where this peer senses.
  void set_foci(std::span<const Focus> foci) noexcept { interest_.set_foci(foci); }
  /// Records that a cell was left: where cells hide entities, the shown ones are judged again.
  void leave_cell() noexcept {
    if (hides_unheard()) leap();
  }
  /// Distance from our entities beyond which cells are not joined [m], >= 0, see Focus::cut;
  /// infinite at first. Entities in them are hidden.
  void set_cut(double metres) noexcept { cut_ = metres; }
  [[nodiscard]] double cut() const noexcept { return cut_; }
  /// Whether the cut hides this position: its cell is not joined.
  [[nodiscard]] bool is_cut_off(const Position& position) const noexcept {
    return cut_ < std::numeric_limits<double>::infinity() && is_unheard(position);
  }

  /// Beacons that we follow, as of the last follow().
  [[nodiscard]] std::span<const FollowedBeacon> followed() const noexcept { return followed_; }
  /// Looks for each of them: `find(tag)` returns its row in a map of groups, like a pdu::CellGroup
  /// with column, row and group, or none. The last cell of a beacon that is not found stays
  /// subscribed for a time, because only an update of its owner or of the map may have been lost.
  /// @return numbers of the cells in which they are
  std::span<const GroupIndex> follow(std::chrono::nanoseconds now,
                                     std::chrono::nanoseconds missed_for, auto&& find) {
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
  // Shares of the side of a cell. A shown entity lingers beyond the followed cell; one on a border
  // is in one cell for its owner, and may be in the other by the rounding of the wire format; and
  // it may be predicted in the other within its owner's threshold.
  static constexpr double kLingers = 0.5;
  static constexpr double kBorder = 1e-8;
  static constexpr double kPredicted = 0.05;

  /// @param share as in is_in_or_near
  [[nodiscard]] bool is_followed(const Position& position, double share) const noexcept {
    return !followed_.empty() && is_in_followed_cell(position, share);
  }
  /// @param share of a cell's side by which the cell may be away
  [[nodiscard]] bool is_in_or_near(const Position& position, double share,
                                   auto&& is_one) const noexcept {
    if (is_one(cells_.group(position))) return true;
    const double beyond = share * finest_;
    bool found = false;
    cells_.visit([&](const auto& scheme) {
      scheme.for_each_cell_within(position, beyond, [&](CellId cell, double) {
        found = found || is_one(scheme.group(cell));
      });
    });
    return found;
  }
  [[nodiscard]] bool is_in_followed_cell(const Position& position, double share) const noexcept {
    if (!is_finite(position)) return false;
    return is_in_or_near(position, share, [this](GroupIndex number) {
      return std::find(besides_.begin(), besides_.end(), number) != besides_.end();
    });
  }
  [[nodiscard]] bool hides_unheard() const noexcept {
    return cut_ < std::numeric_limits<double>::infinity() || cells_.as<LocaleMap>() != nullptr;
  }
  [[nodiscard]] bool is_walled_off(const Position& position) const noexcept {
    return hides_unheard() && is_unheard(position);
  }
  [[nodiscard]] bool is_unheard(const Position& position) const noexcept {
    // A position beyond the wall of a locale is another locale, at any distance.
    if (!is_finite(position)) return false;
    if (cells_.as<LocaleMap>() != nullptr) return !subscription_.is_joined(cells_.group(position));
    return !is_in_or_near(position, kPredicted,
                          [this](GroupIndex number) { return subscription_.is_joined(number); });
  }
  void leap() noexcept { leapt_ += 2.0 * Interest::kFarthest; }

  const CellPartition& cells_;
  const Subscription& subscription_;
  Interest interest_;
  double finest_;
  bool receives_all_;
  double cut_ = std::numeric_limits<double>::infinity();
  double leapt_ = 0.0;  // [m], see withdrawn()
  std::vector<FollowedBeacon> followed_;
  std::vector<GroupIndex> besides_;  // numbers of their cells
};

}  // namespace reckon::aoim

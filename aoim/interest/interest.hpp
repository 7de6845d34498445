// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The receiver's exact test, after the switch, the network card and the kernel have dropped what
// they could by group: whether an entity's nimbus meets the focus of one of ours. Aura = the cells
// (cheap bound); focus = a ball around each local entity; nimbus = a ball around the remote one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/interest/awareness.hpp"
#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// Result of the exact test for one remote entity.
enum class InterestVerdict : std::uint8_t {
  inside,      ///< within R: show it, take its update
  lingering,   ///< already shown, between R and leave_factor R: keep it
  left,        ///< was shown and is now outside: drop its row
  outside,     ///< not shown and outside: ignore
  class_off,   ///< its entity kind is not wanted
  not_finite,  ///< its position is NaN or infinite: ignore, and count
  hidden,      ///< within R, but beyond an aura or behind something solid: as outside
};

/// True if the update is to be used.
[[nodiscard]] constexpr bool is_accepted(InterestVerdict verdict) noexcept {
  return verdict == InterestVerdict::inside || verdict == InterestVerdict::lingering;
}

/// Entities that the filter has passed and dropped since the start, by stage.
struct InterestCounts {
  std::uint64_t accepted = 0, lingering = 0, left = 0, outside = 0, class_off = 0, not_finite = 0;
  std::uint64_t hidden = 0;
};

/// Tunables of the exact test.
struct InterestConfig {
  /// A shown entity is kept up to this times R, so that it does not flicker at the edge;
  /// default 1.1.
  double leave_factor = 1.1;
  /// Bit k set = entities of kind k (IEEE 1278.1 entity kind, 0 .. 31) are wanted; default all.
  std::uint32_t kinds = 0xFFFFFFFFu;
  /// Distance [m] from a focus beyond which nothing is met, whatever its nimbus; default no bound.
  double aura = std::numeric_limits<double>::infinity();
  /// Solid boxes that hide what is behind them from a focus; see Occluders. Default none.
  std::vector<Occluders::Box> occluders;
  /// Most foci; default 64, and in the manager the number of locales if that is larger. Further
  /// ones are ignored (and reported by set_foci).
  std::size_t maximum_foci = 64;
};

/// Exact distance filter. One thread; allocates nothing after construction.
class Interest {
 public:
  /// @throws std::invalid_argument for a box that is empty or not finite.
  explicit Interest(const InterestConfig& config);

  /// Replaces the foci; returns the number kept (finite ones, up to maximum_foci). If they have
  /// changed it costs 2 ns for each pair of an old and a new one.
  std::size_t set_foci(std::span<const Focus> foci) noexcept;

  /// Judges a remote entity at `position` [m, S] with a nimbus of `nimbus` [m]; `shown` = it is in
  /// the state table now. Cost: 2 ns per focus; for one within R some 10 ns more with an aura, and
  /// 5 ns for each box.  @param wanted true: inside at any distance, if its kind is wanted
  InterestVerdict judge(const Position& position, double nimbus, std::uint8_t kind, bool shown,
                        bool wanted = false) noexcept;

  /// Distance [m] of a nimbus around `position` from the nearest focus's radius: 0 or less inside;
  /// infinite if there is no focus or the position is not finite; a little more than 0 if it is
  /// hidden inside. Counts nothing.
  [[nodiscard]] double gap(const Position& position, double nimbus) const noexcept;
  /// Total distance [m] that the foci have withdrawn since the start, which grows with any
  /// movement. A shown entity is not out of sight before this has grown by its spare().
  [[nodiscard]] double withdrawn() const noexcept { return withdrawn_; }
  /// Distance [m] by which the foci and a shown entity may separate before it is to be dropped, at
  /// most kFarthest; 0 if it is to be dropped now. At most kLookAgain if other conditions than
  /// distance apply. Counts nothing.
  [[nodiscard]] double spare(const Position& position, double nimbus, std::uint8_t kind,
                             bool wanted = false) noexcept;
  /// Least spare() of an entity judged `inside` [m].
  [[nodiscard]] double margin() const noexcept { return margin_; }
  /// [m]; withdrawn() grows by twice that after a complete change.
  static constexpr double kFarthest = 1e6;
  static constexpr double kLookAgain = 1.0;  ///< [m]
  /// Distance [m] of the nearest focus; infinite as above.
  [[nodiscard]] double distance_to_focus(const Position& position) const noexcept;
  /// Speed of the fastest focus [m/s].
  [[nodiscard]] double fastest_focus() const noexcept;

  /// Judges an entity that is known to be hidden, at any distance.
  InterestVerdict judge_hidden() noexcept {
    ++counts_.hidden;
    return InterestVerdict::hidden;
  }
  /// Result of gap() for an entity hidden inside [m]: check again soon.
  static constexpr double kHiddenGap = 0.1;

  [[nodiscard]] const InterestCounts& counts() const noexcept { return counts_; }
  /// Smallest distance [m] from a focus, minus the nimbus, of the entities judged `outside` since
  /// the last call; infinite: none.
  [[nodiscard]] double take_nearest_outside() noexcept;

 private:
  [[nodiscard]] InterestVerdict verdict(const Position& position, double nimbus, std::uint8_t kind,
                                        bool shown, bool wanted) noexcept;
  [[nodiscard]] bool is_aware(const Focus& focus, const Position& position, double nimbus,
                              double slack) const noexcept;
  [[nodiscard]] double withdrawal() const noexcept;

  InterestConfig config_;
  Occluders occluders_;
  bool asks_more_;  // whether other conditions than distance apply
  std::vector<Focus> foci_;
  std::vector<Focus> former_;  // foci before the present ones
  double withdrawn_ = 0.0;     // [m]
  double margin_ = 0.0;        // [m]
  InterestCounts counts_;
  double nearest_outside_ = std::numeric_limits<double>::infinity();  // [m]
};

}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How far around our entities cells are joined, so that what is heard meets a budget.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace reckon::aoim {

struct ReachLimitConfig {
  double budget = 0.0;    ///< [B/s], > 0
  double farthest = 0.0;  ///< radius in which our entities sense [m], > 0
  double cell = 0.0;      ///< side of the smallest cell [m], > 0
};

/// A controller: what is heard for two seconds decides. Over the budget for two such stretches in
/// turn, it cuts the most distant cells, by the area that the excess takes if entities are evenly
/// spread, and looks again 3 s later; below 80 % of the budget it lets more in, up to a quarter of
/// the distance. A step outwards that proves too much is taken back, and the next one waits twice
/// as long, 20 s to 160 s. One thread; allocates nothing.
class ReachLimit {
 public:
  explicit ReachLimit(const ReachLimitConfig& config) : config_(config) {}

  /// Notes the octets of all datagrams heard since the start. Call it some times a second.
  void note(std::uint64_t octets, std::chrono::nanoseconds now) noexcept;

  /// Cells farther than this from our entities are not to be joined [m]; infinite while all fit,
  /// 0 for the cells of our entities alone.
  [[nodiscard]] double cut() const noexcept { return cut_; }
  [[nodiscard]] bool is_cut() const noexcept {
    return cut_ < std::numeric_limits<double>::infinity();
  }
  /// The last measured rate [B/s].
  [[nodiscard]] double heard() const noexcept { return heard_; }
  /// Whether the last measured rate was within the budget, after any cut.
  [[nodiscard]] bool is_met() const noexcept { return heard_ <= config_.budget; }
  /// Whether nothing is left to cut and more than the budget is heard nevertheless.
  [[nodiscard]] bool is_unmet() const noexcept { return cut_ <= 0.0 && !is_met(); }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  void lower(Nanoseconds now) noexcept;
  void raise(Nanoseconds now) noexcept;
  void set(double cut, Nanoseconds now) noexcept;

  ReachLimitConfig config_;
  double cut_ = std::numeric_limits<double>::infinity();
  double heard_ = 0.0;
  bool begun_ = false;
  std::uint64_t from_ = 0;  // octets at the begin of the stretch
  Nanoseconds since_{};     // begin of the stretch; in the future after a change
  int over_ = 0;            // stretches over the budget in turn
  bool closing_ = false;    // the last changes were cuts, and more than the budget was heard since
  double before_ = 0.0;     // cut before the last step outwards
  bool raised_ = false;     // the last change was such a step, and is not yet judged
  Nanoseconds hold_ = std::chrono::seconds(20);
  Nanoseconds raise_after_{};
};

}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits the radius around our entities in which cells are joined, to keep the receive rate within
// a budget.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace reckon::aoim {

struct ReachLimitConfig {
  double budget = 0.0;    ///< [B/s], > 0
  double farthest = 0.0;  ///< sensing radius of our entities [m], > 0
  double cell = 0.0;      ///< side of the smallest cell [m], > 0
};

/// A controller. It measures the receive rate over intervals of 2 s. After two consecutive
/// intervals above the budget it cuts the most distant cells, by the area of the excess for evenly
/// spread entities, and measures again 3 s later. One interval suffices while it is cutting, or if
/// its own step outwards exceeded the budget by far. Below 80 % of the budget it extends the
/// radius, by up to a quarter. A step outwards that exceeds the budget is undone, and the next one
/// waits twice as long, 20 s to 160 s. One thread; allocates nothing.
class ReachLimit {
 public:
  explicit ReachLimit(const ReachLimitConfig& config) : config_(config) {}

  /// Takes the octets of all datagrams received since the start. Call it several times a second.
  void note(std::uint64_t octets, std::chrono::nanoseconds now) noexcept;

  /// Distance from our entities beyond which cells are not joined [m]; infinite: no limit; 0: only
  /// the cells of our entities.
  [[nodiscard]] double cut() const noexcept { return cut_; }
  [[nodiscard]] bool is_cut() const noexcept {
    return cut_ < std::numeric_limits<double>::infinity();
  }
  /// The last measured rate [B/s].
  [[nodiscard]] double heard() const noexcept { return heard_; }
  /// Whether the last measured rate was within the budget, after any cut.
  [[nodiscard]] bool is_met() const noexcept { return heard_ <= config_.budget; }
  /// Whether the rate exceeds the budget with nothing left to cut.
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
  std::uint64_t from_ = 0;  // octets at the start of the interval
  Nanoseconds since_{};     // start of the interval; in the future after a change
  int over_ = 0;            // consecutive intervals above the budget
  bool closing_ = false;  // the last changes were cuts, and the rate has exceeded the budget since
  double before_ = 0.0;   // cut before the last step outwards
  bool raised_ = false;   // the last change was a step outwards, not judged yet
  Nanoseconds hold_ = std::chrono::seconds(20);
  Nanoseconds raise_after_{};
};

}  // namespace reckon::aoim

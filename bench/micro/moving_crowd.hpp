// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities in a square, with 48 others within 200 m of each on average. In each tick a share of
// them moves straight by 0.5 to 1.5 % of that radius; one of 50 turns first. An entity that leaves
// the square re-enters at the opposite side.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/bench/interest/incremental_interest.hpp"

namespace reckon::bench {

class MovingCrowd {
 public:
  static constexpr double kRadius = 200.0, kNeighbours = 48.0;

  MovingCrowd(std::size_t count, unsigned percent_moving)
      : extent_(kRadius * std::sqrt(static_cast<double>(count) * std::numbers::pi / kNeighbours)),
        percent_(percent_moving) {
    for (std::size_t i = 0; i < count; ++i) {
      positions_.push_back({extent_ * unit_(random_), extent_ * unit_(random_), 0.0});
      pace_.push_back(kRadius * (0.005 + 0.01 * unit_(random_)));
      step_x_.push_back(0);
      step_y_.push_back(0);
      turn(i);
    }
  }

  /// One tick; calls moved(i, position) for each entity that moves.
  template <typename Moved>
  void walk(Moved&& moved) {
    for (std::uint32_t i = 0; i < positions_.size(); ++i) {
      if (percent_ < 100 && random_() % 100 >= percent_) continue;
      if (random_() % 50 == 0) turn(i);
      positions_[i].x = inside(positions_[i].x + step_x_[i]);
      positions_[i].y = inside(positions_[i].y + step_y_[i]);
      moved(i, positions_[i]);
    }
  }
  [[nodiscard]] const std::vector<aoim::Position>& positions() const noexcept { return positions_; }

 private:
  void turn(std::size_t i) {
    const double heading = 2.0 * std::numbers::pi * unit_(random_);
    step_x_[i] = pace_[i] * std::cos(heading);
    step_y_[i] = pace_[i] * std::sin(heading);
  }
  [[nodiscard]] double inside(double x) const noexcept {
    return x < 0 ? x + extent_ : (x >= extent_ ? x - extent_ : x);
  }

  double extent_;
  unsigned percent_;
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
  std::vector<aoim::Position> positions_;
  std::vector<double> pace_, step_x_, step_y_;
};

/// All entities of a crowd, after the initial changes have been reported.
inline bench::IncrementalInterest interest_of(const MovingCrowd& crowd) {
  const std::vector<aoim::Position>& positions = crowd.positions();
  bench::IncrementalInterest interest(positions.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    interest.add(i, positions[i], MovingCrowd::kRadius);
  }
  static_cast<void>(interest.step());
  return interest;
}

}  // namespace reckon::bench

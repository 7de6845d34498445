// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Pairs of moving bodies in the order of the earliest time at which they may collide
// (thesis 2.5.6). A pair is looked at when that time has come, and not before.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/haptics/queries/cell_grid.hpp"

namespace reckon::haptics {

/// What is known of a body's motion, as dead reckoning has it. Time in seconds of one clock.
struct BodyMotion {
  double time = 0.0;                                   ///< [s] of what follows
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], of its middle
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  double radius = 0.0;                                 ///< [m], of a ball that holds it, >= 0
  double most_acceleration = 0.0;                      ///< [m/s^2] from `time` on, >= 0
  double most_speed = std::numeric_limits<double>::infinity();  ///< [m/s] from `time` on
};

/// The earliest time at or after `now` [s] at which the balls of two bodies may touch: a lower
/// bound that is exact for straight paths at a constant velocity; infinity for never.
[[nodiscard]] double earliest_contact(const BodyMotion& a, const BodyMotion& b,
                                      double now) noexcept;

/// All pairs of up to a few hundred bodies; memory for each pair. A motion holds until it is
/// reported otherwise: a body reports when it no longer keeps to what it said (more acceleration,
/// another velocity, larger), and need not as long as it does.
///
/// Cost: a pair that is due 0.1 us and the logarithm of the pairs; a report that of a pair for each
/// other body. Allocates at construction only. One thread.
class PairQueue {
 public:
  /// @param bodies numbers 0 to bodies - 1, at most 4096; none takes part before its first report
  /// @throws std::invalid_argument for more
  explicit PairQueue(std::size_t bodies);

  /// The motion of a body from now on. All pairs with it get a new time.
  void report(std::uint32_t body, const BodyMotion& motion, double now) noexcept;
  /// Takes it out, until its next report.
  void remove(std::uint32_t body) noexcept;

  /// The pairs whose balls may touch at or before `now`, by what was reported; each of them is to
  /// be tested by its shapes. They come back with the next call as long as that holds. Times do not
  /// go back. Valid until the next call.
  [[nodiscard]] std::span<const BoxPair> due(double now) noexcept;
  /// The time at which due() first has something to do [s]; infinity for never.
  [[nodiscard]] double next_due() const noexcept;
  /// Pairs whose time was computed, since the start.
  [[nodiscard]] std::uint64_t tests() const noexcept { return tests_; }

 private:
  struct Entry {
    double time;
    std::uint32_t pair;
  };

  [[nodiscard]] static std::uint32_t number_of(std::uint32_t low, std::uint32_t high) noexcept {
    return high * (high - 1) / 2 + low;
  }
  void set_time(std::uint32_t pair, double time) noexcept;
  void settle(std::size_t place) noexcept;
  void put(std::size_t place, const Entry& entry) noexcept;

  std::vector<BodyMotion> motions_;
  std::vector<bool> present_;
  std::vector<Entry> heap_;            // the earliest first
  std::vector<std::uint32_t> places_;  // of each pair in the heap
  std::vector<BoxPair> bodies_of_;     // of each pair
  std::vector<BoxPair> due_;
  std::uint64_t tests_ = 0;
};

}  // namespace reckon::haptics

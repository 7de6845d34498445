// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Queue of pairs of moving bodies by the earliest time of a possible collision (thesis 2.5.6). A
// pair is tested only at that time.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/haptics/queries/cell_grid.hpp"

namespace reckon::haptics {

/// Motion of a body by dead reckoning. Times in seconds of one clock.
struct BodyMotion {
  double time = 0.0;                                   ///< [s], time of the following state
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], of its center
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
  double radius = 0.0;                                 ///< [m], >= 0, of a ball that contains it
  double most_acceleration = 0.0;                      ///< [m/s^2] from `time` on, >= 0
  double most_speed = std::numeric_limits<double>::infinity();  ///< [m/s] from `time` on
};

/// Earliest time from `now` [s] on at which the balls of two bodies may touch: a lower bound, exact
/// for constant velocities; infinity: never.
[[nodiscard]] double earliest_contact(const BodyMotion& a, const BodyMotion& b,
                                      double now) noexcept;

/// All pairs of up to a few hundred bodies; memory for each pair. A motion is valid until the next
/// report: a body must report a new motion when it violates the last one (more acceleration,
/// another velocity, a larger radius).
///
/// Cost: 0.1 us for a due pair, plus the logarithm of the pairs; a report as much for each other
/// body. Allocates at construction only. One thread.
class PairQueue {
 public:
  /// @param bodies at most 4096, numbers 0 to bodies - 1; each is active from its first report on
  /// @throws std::invalid_argument for more
  explicit PairQueue(std::size_t bodies);

  /// Sets the motion of a body. All its pairs get a new time.
  void report(std::uint32_t body, const BodyMotion& motion, double now) noexcept;
  /// Deactivates a body until its next report.
  void remove(std::uint32_t body) noexcept;

  /// The pairs whose balls may touch at or before `now`, by their reports; the caller tests their
  /// shapes. They are returned again while this is so. `now` never decreases. Valid until the next
  /// call.
  [[nodiscard]] std::span<const BoxPair> due(double now) noexcept;
  /// Earliest time of a due pair [s]; infinity: never.
  [[nodiscard]] double next_due() const noexcept;
  /// Number of computed times since the start.
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
  std::vector<Entry> heap_;            // earliest first
  std::vector<std::uint32_t> places_;  // index in the heap, by pair
  std::vector<BoxPair> bodies_of_;     // by pair
  std::vector<BoxPair> due_;
  std::uint64_t tests_ = 0;
};

}  // namespace reckon::haptics

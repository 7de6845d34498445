// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which islands of a step the exact solver takes, and how often the iterative one iterates the
// others.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "reckon/haptics/bodies/island_energy.hpp"

namespace reckon::haptics {

struct PlannedIsland {
  BodySet bodies = 0;
  int contacts = 0;
  bool is_exact = true;
  int iterations = 0;  ///< if it is not exact; 0: as many as it may have
};

/// The plan of one step within a budget of counted work. Islands that hands push get the exact
/// solver first, then the smallest. O(bodies); one thread; allocates nothing.
class IslandPlan {
 public:
  /// Greatest number of contacts of an island for which the exact solver is faster. Its cost is
  /// cubic, and with more contacts it mostly finds no solution.
  static constexpr int kMostExact = 24;

  /// Iterations of an island, if the exact solver does not take it or finds no solution.
  [[nodiscard]] static int iterations_of(const PlannedIsland& island) noexcept;
  /// Counted work of an island with this many contacts, without a budget [s].
  [[nodiscard]] static double work_of(double contacts) noexcept;

  /// @param pushed bodies that hands push  @param seconds see CountedWork
  void make(BodySet bodies, IslandEnergy::Islands& islands, BodySet pushed,
            double seconds) noexcept;
  /// In the order of their first slots. Bodies without a contact are islands too.
  [[nodiscard]] std::span<const PlannedIsland> islands() const noexcept {
    return std::span(islands_).first(count_);
  }
  /// Bodies that the exact solver does not take.
  [[nodiscard]] BodySet iterated() const noexcept { return iterated_; }
  /// Counted work of the solutions.
  [[nodiscard]] double seconds() const noexcept { return seconds_; }

 private:
  [[nodiscard]] std::span<PlannedIsland> all() noexcept {
    return std::span(islands_).first(count_);
  }
  void list(BodySet bodies, IslandEnergy::Islands& islands) noexcept;
  void choose_exact(BodySet pushed, double& rest) noexcept;
  void choose_iterations(double rest) noexcept;

  std::array<PlannedIsland, BodySlots::kMost> islands_{};
  std::size_t count_ = 0;
  BodySet iterated_ = 0;
  double seconds_ = 0.0;
};

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the hands of a run would feel if there were no line, no sampling and no limit: the force to
// compare with.
#pragma once

#include <array>

#include "reckon/bench/baselines/coupling_world.hpp"

namespace reckon::bench {

struct CouplingRun;

/// The same operators and devices on the environment itself, which acts within the plant's own
/// steps of 0.1 ms or less (semi-implicit).
class UndelayedTruth {
 public:
  /// @param run outlives it
  explicit UndelayedTruth(const CouplingRun& run);

  /// Force between them now [N] >= 0.
  [[nodiscard]] double force() const noexcept;
  /// One sample on.
  void step() noexcept;

 private:
  struct Body {
    double position = 0.0, speed = 0.0;
  };
  void move(Body& body, const OperatorModel& hand, double start, double contact) const noexcept;

  const CouplingRun& run_;
  bool two_;
  int substeps_;
  double h_;  // [s]
  long count_ = 0;
  std::array<Body, 2> bodies_;
};

}  // namespace reckon::bench

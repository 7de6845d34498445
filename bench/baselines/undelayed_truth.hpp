// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force that the hands of a run would feel without a line, sampling and limits: the reference.
#pragma once

#include <array>

#include "reckon/bench/baselines/coupling_world.hpp"

namespace reckon::bench {

struct CouplingRun;

/// The same operators and devices on the environment itself, which acts in the plant's own steps of
/// 0.1 ms or less (semi-implicit).
class UndelayedTruth {
 public:
  /// @param run must outlive it
  explicit UndelayedTruth(const CouplingRun& run);

  /// Current force between them [N] >= 0.
  [[nodiscard]] double force() const noexcept;
  /// Computes the next sample.
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

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How right the forces of a run were.
#pragma once

#include <cstddef>
#include <vector>

namespace reckon::bench {

struct CouplingOutcome;

/// Gathers shown forces beside true ones. One thread; notes do not allocate up to twice `samples`.
class ForceComparison {
 public:
  explicit ForceComparison(std::size_t samples);

  /// @param shown on a hand  @param truth undelayed, left out where both are 0  @param here of the
  /// environment where the hands are; all [N], away from the contact
  void note(double shown, double truth, double here);
  /// Writes error_rms, error_p95, truth_rms, truth_p95 and stiffness_kept.
  void finish(CouplingOutcome& outcome);

 private:
  std::vector<double> errors_, truths_;  // [N], magnitudes
  double in_phase_ = 0.0;                // sum of shown x here [N^2]
  double here_ = 0.0;                    // sum of here x here [N^2]
};

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Errors of the forces in a run.
#pragma once

#include <cstddef>
#include <vector>

namespace reckon::bench {

struct CouplingOutcome;

/// Collects rendered and true forces. One thread; notes do not allocate up to twice `samples`.
class ForceComparison {
 public:
  explicit ForceComparison(std::size_t samples);

  /// @param shown on a hand @param truth undelayed force; left out if both are 0 @param here force
  ///     of the environment at the positions of the hands; all [N], away from the contact
  void note(double shown, double truth, double here);
  /// Writes error_rms, error_p95, truth_rms, truth_p95 and stiffness_kept.
  void finish(CouplingOutcome& outcome);

 private:
  std::vector<double> errors_, truths_;  // [N], magnitudes
  double in_phase_ = 0.0;                // sum of shown x here [N^2]
  double here_ = 0.0;                    // sum of here x here [N^2]
};

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Least and greatest energies of a servo's port since its start.
#pragma once

#include <algorithm>

#include "reckon/haptics/exchange/servo_types.hpp"

namespace reckon::haptics {

/// Servo thread.
class EnergyExtremes {
 public:
  /// Takes the energies of a step, and writes the extremes so far into it.
  void note(ServoSnapshot& step) noexcept {
    step.port_energy_min = port_min_ =
        std::min(port_min_, step.port_energy + step.loan + step.source_energy());
    step.loan_most = loan_most_ = std::max(loan_most_, step.loan);
    step.region_loan_most = region_loan_most_ = std::max(region_loan_most_, step.region_loan);
  }

 private:
  double port_min_ = 0.0;
  double loan_most_ = 0.0;
  double region_loan_most_ = 0.0;
};

}  // namespace reckon::haptics

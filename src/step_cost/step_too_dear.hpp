// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The reason why a federate with devices does not join: this host is too slow for its servo's
// steps.
#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

namespace reckon::peer {

/// One step takes longer than the period of the servo, so this host cannot run the servo,
/// regardless of all other conditions. what() names the dearest stages and the remedy.
class StepTooDear : public std::runtime_error {
 public:
  StepTooDear(const std::string& finding, double step, std::chrono::nanoseconds period)
      : std::runtime_error(finding +
                           "; remove the costliest, or set FederateOptions::even_if_slow"),
        finding_(finding),
        step_(step),
        period_(period) {}
  /// The finding, without the remedy.
  [[nodiscard]] const std::string& finding() const noexcept { return finding_; }
  /// CPU of the step [s].
  [[nodiscard]] double step() const noexcept { return step_; }
  [[nodiscard]] std::chrono::nanoseconds period() const noexcept { return period_; }

 private:
  std::string finding_;
  double step_;
  std::chrono::nanoseconds period_;
};

}  // namespace reckon::peer

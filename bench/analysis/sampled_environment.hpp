// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Simulates an environment that a transfer function describes, also behind a one-sided surface.
// Off-line code.
#pragma once

#include <algorithm>
#include <utility>

#include "reckon/bench/linear_systems/transfer_function.hpp"

namespace reckon::bench {

/// Computes a force for each speed; initially at rest.
class SampledEnvironment {
 public:
  /// @param environment speed [m/s] to force [N], sampled and proper
  explicit SampledEnvironment(const TransferFunction& environment)
      : system_(to_state_space(environment)), state_(Eigen::VectorXd::Zero(system_.order())) {}

  double step(double velocity) {
    const double force = (system_.C * state_).sum() + system_.D(0, 0) * velocity;
    state_ = (system_.A * state_ + system_.B * velocity).eval();
    return force;
  }

  [[nodiscard]] double sample_period() const noexcept { return system_.sample_period; }

 private:
  StateSpace system_;
  Eigen::VectorXd state_;
};

/// Thesis Fig 3.3: acts on the depth behind a surface, never pulls, and has no force without depth.
class UnilateralEnvironment {
 public:
  explicit UnilateralEnvironment(const TransferFunction& environment) : inner_(environment) {}

  /// @param depth [m], at or below 0: no contact @returns force against the depth [N] >= 0
  double step(double depth) {
    const double now = std::max(0.0, depth), before = std::exchange(depth_, now);
    const double force = inner_.step((now - before) / inner_.sample_period());
    return now > 0 ? std::max(0.0, force) : 0.0;
  }

 private:
  SampledEnvironment inner_;
  double depth_ = 0.0;
};

}  // namespace reckon::bench

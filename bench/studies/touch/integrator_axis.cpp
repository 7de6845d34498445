// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Integrator and rate: a tool that a hand presses into a wall, stepped by four rules at four rates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "reckon/bench/linear_systems/state_space.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"

namespace reckon::bench {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMass = 0.1, kDamping = 1;           // of the tool [kg], [N s/m]
constexpr double kHand = 200, kHandDamping = 3;       // of the hand [N/m], [N s/m]
constexpr double kWall = 800;                         // [N/m]
constexpr double kMiddle = 0.012, kSwing = 0.004;     // of the hand's path [m]
constexpr double kRate = 2 * std::numbers::pi * 3.0;  // [rad/s]
constexpr std::size_t kSteps = 4000;                  // [ms]

/// State of the tool [m], [m/s].
struct Tool {
  double position = 0, velocity = 0;
};

/// The hand's target for the tool [m] and its speed [m/s].
Vector2d target(double time, double phase) {
  return {kMiddle + kSwing * std::sin(kRate * time + phase),
          kSwing * kRate * std::cos(kRate * time + phase)};
}

/// The complete system in continuous time: tool, swinging hand, wall. Stepped exactly.
std::vector<Vector3d> truth(double phase) {
  // States: position, velocity, sine and cosine of the swing, one.
  MatrixXd A = MatrixXd::Zero(5, 5);
  A(0, 1) = 1;
  A(1, 0) = -(kHand + kWall) / kMass;
  A(1, 1) = -(kDamping + kHandDamping) / kMass;
  A(1, 2) = kHand * kSwing / kMass;
  A(1, 3) = kHandDamping * kSwing * kRate / kMass;
  A(1, 4) = kHand * kMiddle / kMass;
  A(2, 3) = kRate;
  A(3, 2) = -kRate;
  const StateSpace sampled = discretise_zero_order_hold(
      {A, MatrixXd::Zero(5, 1), MatrixXd::Identity(5, 5), MatrixXd::Zero(5, 1)}, 1e-3);
  Eigen::VectorXd state(5);
  state << 0, 0, std::sin(phase), std::cos(phase), 1;
  std::vector<Vector3d> forces;
  for (std::size_t i = 0; i < kSteps; ++i, state = sampled.A * state)
    forces.emplace_back(-kWall * state[0], 0, 0);
  return forces;
}

double pull(const Tool& tool, const Vector2d& hand) {
  return kHand * (hand[0] - tool.position) + kHandDamping * (hand[1] - tool.velocity) -
         kDamping * tool.velocity;
}

Tool explicit_euler(const Tool& tool, const Vector2d& hand, double h) {
  const double acceleration = (pull(tool, hand) - kWall * tool.position) / kMass;
  return {tool.position + h * tool.velocity, tool.velocity + h * acceleration};
}

Tool semi_implicit(const Tool& tool, const Vector2d& hand, double h) {
  const double velocity = tool.velocity + h * (pull(tool, hand) - kWall * tool.position) / kMass;
  return {tool.position + h * velocity, velocity};
}

/// Exact for inputs that are held: with the wall's force as an input, as on a device, or with the
/// wall in the model.
class ExactHold {
 public:
  ExactHold(double h, bool wall_held) : wall_held_(wall_held) {
    MatrixXd A(2, 2), B(2, 3);
    A << 0, 1, -(kHand + (wall_held ? 0 : kWall)) / kMass, -(kDamping + kHandDamping) / kMass;
    B << 0, 0, 0, kHand / kMass, kHandDamping / kMass, 1 / kMass;
    const StateSpace sampled =
        discretise_zero_order_hold({A, B, MatrixXd::Identity(2, 2), MatrixXd::Zero(2, 3)}, h);
    A_ = sampled.A;
    B_ = sampled.B;
  }
  Tool operator()(const Tool& tool, const Vector2d& hand, double /*h*/) const {
    const Vector3d input(hand[0], hand[1], wall_held_ ? -kWall * tool.position : 0);
    const Vector2d next = A_ * Vector2d(tool.position, tool.velocity) + B_ * input;
    return {next[0], next[1]};
  }

 private:
  Matrix2d A_;
  Eigen::Matrix<double, 2, 3> B_;
  bool wall_held_;
};

constexpr std::size_t kFinest = 4;  // targets each millisecond

using Targets = std::shared_ptr<const std::vector<Vector2d>>;

Targets targets_of(double phase) {
  std::vector<Vector2d> targets;
  for (std::size_t i = 0; i < kFinest * kSteps; ++i)
    targets.push_back(target(1e-3 / kFinest * static_cast<double>(i), phase));
  return std::make_shared<const std::vector<Vector2d>>(std::move(targets));
}

/// A tool stepped by a rule; its force is read each millisecond.
template <typename Rule>
class Stepped {
 public:
  Stepped(double rate, Targets targets, Rule rule)
      : h_(1 / rate),
        every_(static_cast<std::size_t>(std::max(1.0, 1000 / rate))),
        stride_(static_cast<std::size_t>(1000.0 * kFinest / rate)),
        targets_(std::move(targets)),
        rule_(rule) {}

  /// Returns the force at this millisecond, then steps to the next. Lower rates hold the force.
  double step(std::size_t at) {
    if (at == 0) tool_ = {};
    if (at % every_ != 0) return force_;
    force_ = -kWall * tool_.position;
    for (std::size_t i = 0; i < every_ * kFinest; i += stride_)
      tool_ = rule_(tool_, (*targets_)[kFinest * at + i], h_);
    return force_;
  }

 private:
  double h_;
  std::size_t every_;   // milliseconds from step to step, at least 1
  std::size_t stride_;  // in targets
  Targets targets_;
  Rule rule_;
  Tool tool_;
  double force_ = 0;
};

template <typename Rule>
TouchSetting setting_of(std::string_view name, double rate, const Targets& targets, Rule rule) {
  TouchSetting setting{fmt::format("{}, {:g} kHz", name, 1e-3 * rate), {}, {}};
  Stepped once(rate, targets, rule);
  for (std::size_t i = 0; i < kSteps; ++i) setting.forces.emplace_back(once.step(i), 0, 0);
  setting.run = [stepped = Stepped(rate, targets, rule),
                 at = std::size_t{0}](std::size_t steps) mutable {
    double sum = 0;
    for (std::size_t i = 0; i < steps; ++i, at = at + 1 == kSteps ? 0 : at + 1)
      sum += stepped.step(at);
    return sum;
  };
  return setting;
}

}  // namespace

TouchCase integrator_case(const TouchConditions& conditions) {
  const double phase = phase_of(conditions.seed, 1);
  TouchCase made;
  made.truth = fmt::format(
      "tool of {0} kg, {1} N s/m, moved at 3 Hz in a wall of {3} N/m by a hand of {2} N/m: "
      "continuous time, matrix exponential",
      kMass, kDamping, kHand, kWall);
  made.remark =
      "All sample the hand at the start of a step. Held wall: its force is held over the step, as "
      "a device holds the force of the servo. Below 1 kHz, the force between two steps is the last "
      "one.";
  made.force = truth(phase);
  const Targets targets = targets_of(phase);
  for (const double rate : {500.0, 1000.0, 2000.0, 4000.0}) {
    made.settings.push_back(setting_of("explicit Euler", rate, targets, explicit_euler));
    made.settings.push_back(setting_of("semi-implicit Euler", rate, targets, semi_implicit));
    made.settings.push_back(
        setting_of("exact, held wall", rate, targets, ExactHold(1 / rate, true)));
    made.settings.push_back(
        setting_of("exact with wall", rate, targets, ExactHold(1 / rate, false)));
  }
  return made;
}

}  // namespace reckon::bench

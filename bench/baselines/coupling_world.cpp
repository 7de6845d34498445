// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/baselines/coupling_world.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

namespace reckon::bench {
namespace {

constexpr double kApproach = 0.003;  // [m], motion of the moving surface
constexpr std::array<std::string_view, 4> kEnvironments{"linear", "hardening", "moving",
                                                        "switching"};
constexpr std::array<std::string_view, 3> kOperators{"push", "soft", "tracking"};

haptics::HandTarget at_rest() {
  haptics::HandTarget target;
  target.position.x() = kCouplingStart;
  return target;
}

haptics::HandTarget push(double t) {
  haptics::HandTarget target = at_rest();
  if (t >= kCouplingWait) target.push.x() = 2.0;
  return target;
}

haptics::HandTarget soft(double t) {
  haptics::HandTarget target = at_rest();
  if (t < kCouplingWait) return target;
  target.position.x() = 0.020;
  target.push.x() = 2.0 * std::sin(2 * std::numbers::pi * 0.7 * t);
  return target;
}

haptics::HandTarget tracking(double t) {
  haptics::HandTarget target = at_rest();
  if (t < kCouplingWait) return target;
  target.position.x() = 0.004 + 0.006 * std::sin(2 * std::numbers::pi * t);
  return target;
}

}  // namespace

std::string_view name_of(EnvironmentKind kind) noexcept {
  return kEnvironments[static_cast<std::size_t>(kind)];
}

std::string_view name_of(OperatorKind kind) noexcept {
  return kOperators[static_cast<std::size_t>(kind)];
}

OperatorModel operator_model(OperatorKind kind) {
  switch (kind) {
    case OperatorKind::push:
      return {0.0, 0.0, push};
    case OperatorKind::soft:
      return {100.0, 0.5, soft};
    case OperatorKind::tracking:
      return {500.0, 2.0, tracking};
  }
  return {};
}

OperatorModel resting_operator() {
  return {150.0, 3.0, [](double) { return haptics::HandTarget{}; }};
}

Environment::Environment(EnvironmentKind kind, double stiffness, double period)
    : kind_(kind),
      stiffness_(stiffness),
      period_(period > 0                        ? period
              : kind == EnvironmentKind::moving ? 1.0
                                                : 0.6) {
  if (!(stiffness >= 0 && std::isfinite(stiffness)) || !(period >= 0 && std::isfinite(period)))
    throw std::invalid_argument("environment: stiffness and period must be 0 or more");
  if (kind == EnvironmentKind::hardening) cubic_ = std::pow(stiffness / 4, 3);
}

ContactLaw Environment::at(double t) const noexcept {
  const bool first_half = std::fmod(t, period_) < 0.5 * period_;
  switch (kind_) {
    case EnvironmentKind::linear:
      return {stiffness_, 0.0, 0.0};
    case EnvironmentKind::hardening:
      return {stiffness_ / 4, cubic_, 0.0};
    case EnvironmentKind::moving:
      return {stiffness_, 0.0, first_half ? 0.0 : -kApproach};
    case EnvironmentKind::switching:
      return {first_half ? stiffness_ / 4 : stiffness_, 0.0, 0.0};
  }
  return {};
}

Tangent ContactLaw::tangent(double x) const noexcept {
  const double d = std::max(0.0, x - surface);
  const double slope = k1 + 3 * k3 * d * d;
  return {slope, d > 0 && slope > 0 ? x - force(x) / slope : surface};
}

}  // namespace reckon::bench

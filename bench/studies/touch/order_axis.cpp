// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Order of a force model: an elastic sheet pressed at one node, complete and reduced.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "reckon/bench/linear_systems/state_space.hpp"
#include "reckon/bench/reduction/congruence_reduction.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"

namespace reckon::bench {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

constexpr int kSide = 10;                // nodes of an edge
constexpr double kMass = 2e-3;           // of a node [kg]
constexpr double kSpring = 600;          // between neighbours [N/m]
constexpr double kBed = 4;               // of each node to the ground [N/m]
constexpr double kContact = 900;         // of the contact spring [N/m]
constexpr double kMassDamping = 2;       // [1/s]
constexpr double kSpringDamping = 2e-4;  // [s]
constexpr std::size_t kSteps = 4000;     // [ms]

SecondOrderSystem sheet() {
  std::vector<Eigen::Triplet<double>> springs;
  const auto tie = [&](int a, int b) {
    springs.emplace_back(a, a, kSpring);
    springs.emplace_back(b, b, kSpring);
    springs.emplace_back(a, b, -kSpring);
    springs.emplace_back(b, a, -kSpring);
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const int node = y * kSide + x;
      springs.emplace_back(node, node, kBed);
      if (x + 1 < kSide) tie(node, node + 1);
      if (y + 1 < kSide) tie(node, node + kSide);
    }
  }
  constexpr int kNodes = kSide * kSide;
  SecondOrderSystem body;
  body.M.resize(kNodes, kNodes);
  body.M.setIdentity();
  body.M *= kMass;
  body.K.resize(kNodes, kNodes);
  body.K.setFromTriplets(springs.begin(), springs.end());
  body.D = kMassDamping * body.M + kSpringDamping * body.K;
  body.B = MatrixXd::Zero(kNodes, 1);
  body.B(kSide / 2 * kSide + kSide / 2, 0) = 1;
  return body;
}

/// Probe [m] to force [N] through the contact spring, with all coordinates.
StateSpace whole(const SecondOrderSystem& body) {
  const Eigen::Index n = body.size();
  const MatrixXd inverse = MatrixXd(body.M).inverse();
  StateSpace system;
  system.A = MatrixXd::Zero(2 * n, 2 * n);
  system.A.topRightCorner(n, n).setIdentity();
  system.A.bottomLeftCorner(n, n) =
      -inverse * (MatrixXd(body.K) + kContact * body.B * body.B.transpose());
  system.A.bottomRightCorner(n, n) = -inverse * MatrixXd(body.D);
  system.B = MatrixXd::Zero(2 * n, 1);
  system.B.bottomRows(n) = kContact * inverse * body.B;
  system.C = MatrixXd::Zero(1, 2 * n);
  system.C.leftCols(n) = -kContact * body.B.transpose();
  system.D = MatrixXd::Constant(1, 1, kContact);
  return system;
}

/// Position of the probe [m]: pressed in within half a second, then moved at 2 and 12 Hz.
std::vector<double> motion(std::uint64_t seed) {
  std::vector<double> probe;
  const double slow = phase_of(seed, 1), fast = phase_of(seed, 2);
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double t = 1e-3 * static_cast<double>(i), turn = 2 * std::numbers::pi;
    const double u = std::min(1.0, t / 0.5), in = u * u * u * (10 + u * (6 * u - 15));
    probe.push_back(1e-3 * in *
                    (2 + std::sin(turn * 2 * t + slow) + 0.3 * std::sin(turn * 12 * t + fast)));
  }
  return probe;
}

/// A sampled model in the servo.
class Stepper {
 public:
  explicit Stepper(StateSpace system)
      : system_(std::move(system)), x_(Eigen::VectorXd::Zero(system_.order())), next_(x_) {}

  double step(double probe) {
    const double force = system_.C.row(0).dot(x_) + system_.D(0, 0) * probe;
    next_.noalias() = system_.A * x_;
    next_ += system_.B.col(0) * probe;
    x_.swap(next_);
    return force;
  }

 private:
  StateSpace system_;
  Eigen::VectorXd x_, next_;
};

TouchSetting setting_of(std::string name, const StateSpace& sampled,
                        const std::shared_ptr<const std::vector<double>>& probe) {
  TouchSetting setting{std::move(name), {}, {}};
  Stepper once(sampled);
  for (const double x : *probe) setting.forces.emplace_back(0, 0, once.step(x));
  setting.run = [stepper = Stepper(sampled), probe,
                 at = std::size_t{0}](std::size_t steps) mutable {
    double sum = 0;
    for (std::size_t i = 0; i < steps; ++i, at = at + 1 == probe->size() ? 0 : at + 1)
      sum += stepper.step((*probe)[at]);
    return sum;
  };
  return setting;
}

}  // namespace

TouchCase order_case(const TouchConditions& conditions) {
  const SecondOrderSystem body = checked(sheet());
  const BodyReduction reduction(body);
  const auto probe = std::make_shared<const std::vector<double>>(motion(conditions.seed));
  TouchCase made;
  made.truth = fmt::format(
      "sheet of {0} x {0} masses through {1} N/m, pressed to 3.3 mm at 2 and 12 Hz: all {2} states",
      kSide, kContact, 2 * body.size());
  made.remark = "The probe is held over each millisecond for all, so only the order differs.";
  for (const int modes : {0, 1, 2, 4, 8, 12, 16}) {
    const StateSpace model = force_of_displacement(reduction.model(modes), kContact);
    made.settings.push_back(
        setting_of(modes == 0 ? "static" : fmt::format("{} mode{}", modes, modes > 1 ? "s" : ""),
                   modes == 0 ? model : discretise_zero_order_hold(model, 1e-3), probe));
  }
  made.settings.push_back(setting_of(fmt::format("all {} states", 2 * body.size()),
                                     discretise_zero_order_hold(whole(body), 1e-3), probe));
  made.force = made.settings.back().forces;
  return made;
}

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/contact_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace reckon::bench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kFeasible = 1e-9;  // of a limit
constexpr std::size_t kLeastSamples = 4;
constexpr double kRidge = 1e-9;  // of the normal equations: coefficients that the samples do not
                                 // determine become 0

// Weighted sums over the samples. Unknowns are the forces of k1, k3 and the damper at the deepest
// point and fastest rate, so that they are of similar size.
struct Normal {
  Matrix3d squares = Matrix3d::Zero();
  Vector3d side = Vector3d::Zero();
  Vector3d units = Vector3d::Ones();  // force at a coefficient of 1
  double weight = 0.0, force_squares = 0.0;
};

// row.x <= limit
struct Limit {
  Vector3d row;
  double limit = 0.0;
  const char* reason = "";
};

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("contact fit: " + what);
}

void check(std::span<const ContactSample> samples, const FitLimits& limits) {
  for (double number :
       {limits.device_damping, limits.sample_period, limits.memory, limits.horizon}) {
    if (!(number > 0.0) || !std::isfinite(number)) {
      refuse("a limit is " + std::to_string(number) + "; give numbers > 0");
    }
  }
  if (!(limits.reach >= 1.0)) refuse("reach is " + std::to_string(limits.reach) + "; give >= 1");
  std::size_t inside = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const ContactSample& at = samples[i];
    if (!std::isfinite(at.time + at.depth + at.rate + at.force)) {
      refuse("sample " + std::to_string(i) + " is not finite; leave it out");
    }
    if (i > 0 && at.time < samples[i - 1].time) {
      refuse("sample " + std::to_string(i) + " is before the one before; give them in order");
    }
    if (at.depth > 0.0) ++inside;
  }
  if (inside < kLeastSamples) {
    refuse(std::to_string(inside) + " samples inside the surface, " +
           std::to_string(kLeastSamples) + " are needed; wait for more");
  }
}

Normal normal_equations(std::span<const ContactSample> samples, double memory, double deepest) {
  double fastest = 0.0;
  for (const ContactSample& at : samples) fastest = std::max(fastest, std::abs(at.rate));
  Normal normal;
  normal.units = {deepest, deepest * deepest * deepest, fastest > 0.0 ? fastest : 1.0};
  const double now = samples.back().time;
  for (const ContactSample& at : samples) {
    if (!(at.depth > 0.0)) continue;
    const double weight = std::exp((at.time - now) / memory);
    const Vector3d row =
        Vector3d(at.depth, at.depth * at.depth * at.depth, at.rate).cwiseQuotient(normal.units);
    normal.squares += weight * row * row.transpose();
    normal.side += weight * at.force * row;
    normal.weight += weight;
    normal.force_squares += weight * at.force * at.force;
  }
  normal.squares.diagonal().array() += kRidge * normal.weight;
  return normal;
}

std::array<Limit, 5> limits_of(const FitLimits& limits, const Vector3d& units, double deepest) {
  const double b = limits.device_damping, T = limits.sample_period;
  const double share = kStiffnessShare * 2.0 / T;
  const Vector3d slope(1.0, 3.0 * deepest * deepest, share);
  const Vector3d k1 = Vector3d::UnitX(), k3 = Vector3d::UnitY(), damping = Vector3d::UnitZ();
  std::array<Limit, 5> all{{{-k1, 0.0, "k1 >= 0"},
                            {-k3, 0.0, "k3 >= 0"},
                            {-damping, 0.0, "damping >= 0"},
                            {damping, 0.5 * b, "damping <= half the device's"},
                            {slope, share * b, "stiffness <= what the device shows passively"}}};
  // For the scaled unknowns, each row with length 1.
  for (Limit& one : all) {
    one.row = one.row.cwiseQuotient(units);
    const double length = one.row.norm();
    one.row /= length;
    one.limit /= length;
  }
  return all;
}

// Least squares with the limits in `binding` as equalities.
Vector3d least_with(const Normal& normal, const std::array<Limit, 5>& limits, unsigned binding) {
  const int count = std::popcount(binding);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(3 + count, 3 + count);
  Eigen::VectorXd side = Eigen::VectorXd::Zero(3 + count);
  const double size = normal.squares.trace();
  system.topLeftCorner<3, 3>() = normal.squares / size;
  side.head<3>() = normal.side / size;
  for (int i = 0, row = 3; i < 5; ++i) {
    if ((binding >> i & 1U) == 0) continue;
    const Limit& limit = limits[static_cast<std::size_t>(i)];
    system.block<1, 3>(row, 0) = limit.row.transpose();
    system.block<3, 1>(0, row) = limit.row;
    side[row++] = limit.limit;
  }
  return system.fullPivLu().solve(side).head<3>();
}

double squares_at(const Normal& normal, const Vector3d& x) {
  return std::max(0.0, x.dot(normal.squares * x) - 2.0 * normal.side.dot(x) + normal.force_squares);
}

bool keeps(const std::array<Limit, 5>& limits, const Vector3d& x) {
  return std::all_of(limits.begin(), limits.end(), [&](const Limit& limit) {
    return limit.row.dot(x) <= limit.limit + kFeasible * (std::abs(limit.limit) + x.norm());
  });
}

// A convex problem: its minimum lies where some set of at most three limits binds.
unsigned best_binding(const Normal& normal, const std::array<Limit, 5>& limits, Vector3d& best) {
  double least = std::numeric_limits<double>::infinity();
  unsigned binding = 0;
  for (unsigned set = 0; set < 32; ++set) {
    if (std::popcount(set) > 3) continue;
    const Vector3d x = least_with(normal, limits, set);
    if (!x.allFinite() || !keeps(limits, x)) continue;
    const double squares = squares_at(normal, x);
    if (squares >= least) continue;
    least = squares;
    best = x;
    binding = set;
  }
  return binding;
}

// Error of holding each force for the horizon; 0 if the window is shorter.
double hold_error(std::span<const ContactSample> samples, double horizon) {
  double squares = 0.0;
  std::size_t count = 0, from = 0;
  for (const ContactSample& at : samples) {
    if (at.time - samples.front().time < horizon) continue;
    while (samples[from + 1].time <= at.time - horizon) ++from;
    squares += (at.force - samples[from].force) * (at.force - samples[from].force);
    ++count;
  }
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0.0;
}

}  // namespace

double ContactCoefficients::force(double depth, double rate) const noexcept {
  if (!(depth > 0.0)) return 0.0;
  return std::max(0.0, k1 * depth + k3 * depth * depth * depth + damping * rate);
}

double ContactCoefficients::stiffness(double depth) const noexcept {
  return depth > 0.0 ? k1 + 3.0 * k3 * depth * depth : 0.0;
}

ContactFit fit_contact(std::span<const ContactSample> samples, const FitLimits& limits) {
  check(samples, limits);
  ContactFit fit;
  for (const ContactSample& at : samples) fit.deepest = std::max(fit.deepest, at.depth);
  const Normal normal = normal_equations(samples, limits.memory, fit.deepest);
  fit.deepest *= limits.reach;
  const std::array<Limit, 5> rows = limits_of(limits, normal.units, fit.deepest);
  Vector3d best = Vector3d::Zero();
  const unsigned binding = best_binding(normal, rows, best);
  for (unsigned i = 0; i < rows.size(); ++i) {
    if ((binding >> i & 1U) == 0) continue;
    fit.binding += (fit.binding.empty() ? "" : ", ") + std::string(rows[i].reason);
  }
  const Vector3d coefficients = best.cwiseQuotient(normal.units).cwiseMax(0.0);
  fit.contact = {coefficients[0], coefficients[1], coefficients[2]};
  fit.error = std::sqrt(squares_at(normal, best) / normal.weight);
  fit.hold_error = hold_error(samples, limits.horizon);
  fit.lasts = limits.horizon;
  return fit;
}

}  // namespace reckon::bench

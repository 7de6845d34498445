// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/linear_systems/stability.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <vector>

namespace reckon::bench {
namespace {

using Complex = std::complex<double>;

constexpr double kOneRoot = 3e-6;  // a double root moves by the root of the rounding error
constexpr double kOnBorder = 1e-9;

struct Cluster {
  Complex mean = 0;
  Eigen::Index count = 0;
};

// A perturbed multiple root spreads; its mean hardly moves.
std::vector<Cluster> clusters_of(const Eigen::VectorXcd& roots, double distance) {
  std::vector<Cluster> clusters;
  for (const Complex root : roots) {
    const auto near = std::find_if(clusters.begin(), clusters.end(), [&](const Cluster& c) {
      return std::abs(c.mean - root) <= distance;
    });
    Cluster& c = near != clusters.end() ? *near : clusters.emplace_back();
    const auto n = static_cast<double>(c.count);
    c.mean = (c.mean * n + root) / (n + 1.0);
    ++c.count;
  }
  return clusters;
}

using IsSimple = std::function<bool(const Cluster&)>;

StabilityReport judge(const Eigen::VectorXcd& roots, double sample_period,
                      const IsSimple& is_simple) {
  const bool sampled = sample_period > 0;
  const double scale = sampled || roots.size() == 0 ? 1.0 : roots.cwiseAbs().maxCoeff();
  StabilityReport report{Stability::asymptotic, std::numeric_limits<double>::infinity(), false};
  for (const Cluster& c : clusters_of(roots, kOneRoot * scale)) {
    const double inside = sampled ? 1.0 - std::abs(c.mean) : -c.mean.real();
    report.margin = std::min(report.margin, inside);
    if (std::abs(inside) <= kOnBorder * scale && !is_simple(c)) report.multiple_on_border = true;
  }
  if (report.margin < -kOnBorder * scale || report.multiple_on_border) {
    report.verdict = Stability::unstable;
  } else if (report.margin <= kOnBorder * scale) {
    report.verdict = Stability::marginal;
  }
  return report;
}

// Whether there are as many eigenvectors as roots: A - p I has lost that much rank.
bool has_all_eigenvectors(const Eigen::MatrixXd& A, const Cluster& c) {
  Eigen::MatrixXcd shifted = A.cast<Complex>();
  shifted.diagonal().array() -= c.mean;
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXcd>(shifted).singularValues();
  const double rank_border = kOneRoot * std::max(A.norm(), 1e-300);
  return (singular.array() <= rank_border).count() >= c.count;
}

}  // namespace

StabilityReport judge_roots(const Eigen::VectorXcd& roots, double sample_period) {
  return judge(roots, sample_period, [](const Cluster& c) { return c.count == 1; });
}

StabilityReport judge_stability(const StateSpace& system) {
  const StateSpace s = checked(system);
  return judge(poles(s), s.sample_period,
               [&](const Cluster& c) { return c.count == 1 || has_all_eigenvectors(s.A, c); });
}

double spectral_radius(const StateSpace& system) {
  if (!system.is_sampled()) {
    throw std::invalid_argument("a spectral radius is that of a sampled system; discretise it");
  }
  return system.order() == 0 ? 0.0 : poles(system).cwiseAbs().maxCoeff();
}

}  // namespace reckon::bench

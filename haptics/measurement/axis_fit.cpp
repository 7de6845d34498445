// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/measurement/axis_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace reckon::haptics {
namespace {

using Parameters = Eigen::Vector4d;  // ln mass, damping, friction, delay

// Integration steps of the search, and of its last descent [periods].
constexpr double kCoarse = 1.0, kFine = 0.1;
constexpr int kMostIterations = 40;
constexpr std::size_t kDescents = 3;                    // from the best starting points
constexpr double kLeastMass = 1e-3, kMostMass = 100.0;  // [kg]

AxisModel model_of(const Parameters& p) {
  return {std::exp(p(0)), p(1), std::max(0.0, p(2)), std::max(0.0, p(3))};
}

// Integral of the forces of a push from its first write on [N s]; before it the force is zero.
class Impulse {
 public:
  explicit Impulse(const AxisPush& push) : push_(push), sums_(push.forces.size(), 0.0) {
    for (std::size_t k = 1; k < sums_.size(); ++k)
      sums_[k] = sums_[k - 1] + push.forces[k - 1] * (push.writes[k] - push.writes[k - 1]);
  }
  // Times never decrease.
  double until(double time) {
    const std::vector<double>& writes = push_.writes;
    if (!(time > writes.front())) return 0.0;
    while (k_ + 1 < writes.size() && writes[k_ + 1] <= time) ++k_;
    return sums_[k_] + push_.forces[k_] * (time - writes[k_]);
  }

 private:
  const AxisPush& push_;
  std::vector<double> sums_;
  std::size_t k_ = 0;
};

// Positions next to a change of the reading. At the others the quantization error of the sensor is
// unknown, and the same for all of a run.
std::vector<std::size_t> telling(const AxisPush& push) {
  const std::vector<double>& p = push.places;
  std::vector<std::size_t> some;
  for (std::size_t k = 1; k + 1 < p.size(); ++k)
    if (p[k] != p[k - 1] || p[k] != p[k + 1]) some.push_back(k);
  return some;
}

// Subtracts from values their projection on others, or their mean.
void leave_out(std::span<double> values, std::span<const double> along) {
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    product += values[i] * along[i];
    square += along[i] * along[i];
  }
  if (square == 0.0) return;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= product / square * along[i];
}
void leave_out_mean(std::span<double> values) {
  leave_out(values, std::vector<double>(values.size(), 1.0));
}

// Distance after an initial speed of 1 m/s, without dry friction: with it, no handle creeps.
double coasted(const AxisModel& model, double time) {
  const double share = model.damping * time / model.mass;
  return std::abs(share) < 1e-6 ? time : -std::expm1(-share) * model.mass / model.damping;
}

// The quantization error of the first position is unknown too, so the mean of each push is
// subtracted, and the effect of an initial speed if the handle crept.
Eigen::VectorXd residuals(const std::vector<AxisPush>& pushes, const Parameters& p,
                          double substep) {
  std::vector<double> all;
  const AxisModel model = model_of(p);
  for (const AxisPush& push : pushes) {
    const std::vector<double> said = places_of(model, push, substep);
    const std::size_t first = all.size();
    std::vector<double> ways;
    for (const std::size_t k : telling(push)) {
      all.push_back(said[k] - push.places[k]);
      ways.push_back(coasted(model, push.reads[k] - push.reads.front()));
    }
    const std::span<double> own = std::span(all).subspan(first);
    leave_out_mean(own);
    if (!push.creeps) continue;
    leave_out_mean(ways);
    leave_out(own, ways);
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

Eigen::MatrixXd slopes(const std::vector<AxisPush>& pushes, const Parameters& p,
                       const Eigen::VectorXd& at, double substep) {
  const Parameters steps(1e-4, 1e-4, 1e-4, 1e-5);
  Eigen::MatrixXd out(at.size(), 4);
  for (Eigen::Index i = 0; i < 4; ++i) {
    Parameters there = p;
    there(i) += steps(i);
    out.col(i) = (residuals(pushes, there, substep) - at) / steps(i);
  }
  return out;
}

struct Descent {
  Parameters place;
  double cost = std::numeric_limits<double>::infinity();
};

Parameters bounded(Parameters p, double longest_delay) {
  p(0) = std::clamp(p(0), std::log(kLeastMass), std::log(kMostMass));
  p(2) = std::max(0.0, p(2));
  p(3) = std::clamp(p(3), 0.0, longest_delay);
  return p;
}

Descent descend(const std::vector<AxisPush>& pushes, Parameters p, double substep,
                double longest_delay) {
  Eigen::VectorXd at = residuals(pushes, p, substep);
  Descent best{p, at.squaredNorm()};
  double care = 1e-3;
  for (int i = 0; i < kMostIterations && care < 1e8; ++i) {
    const Eigen::MatrixXd J = slopes(pushes, best.place, at, substep);
    Eigen::Matrix4d H = J.transpose() * J;
    H.diagonal() *= 1.0 + care;
    H.diagonal().array() += 1e-18;
    const Parameters step = H.ldlt().solve(J.transpose() * at);
    const Parameters next = bounded(best.place - step, longest_delay);
    const Eigen::VectorXd there = residuals(pushes, next, substep);
    const double cost = there.squaredNorm();
    if (!(cost < best.cost)) {
      care *= 10;
      continue;
    }
    const bool settled = cost > best.cost * (1 - 1e-7) && care < 1e-6;
    best = {next, cost};
    at = there;
    care = std::max(1e-9, care / 10);
    if (settled) break;
  }
  return best;
}

// Where dry friction holds the handle, the cost has corners, and a descent may end in one. They
// mostly hide the delay, or mistake dry friction for viscous. So descents start from other values
// around the best until none improves it.
Descent search_about(const std::vector<AxisPush>& pushes, Descent best, double period,
                     double longest_delay) {
  constexpr int kMostRounds = 6;
  const auto attempt = [&](const Parameters& there) {
    const Descent one =
        descend(pushes, bounded(there, longest_delay), kCoarse * period, longest_delay);
    if (one.cost < best.cost) best = one;
  };
  for (int round = 0; round < kMostRounds; ++round) {
    const double before = best.cost;
    for (const double ways : {-2.0, -0.7, 0.7, 2.0})
      attempt(best.place + Parameters(0, 0, 0, ways * period));
    const Parameters p = best.place;
    for (const double more : {1.0, 2.0}) attempt({p(0), more * p(1), 0.0, p(3)});
    if (best.cost > 0.999 * before) break;
  }
  return best;
}

}  // namespace

// Semi-implicit steps with exact decay, so that long steps are stable too; the force is its mean
// over the step.
std::vector<double> places_of(const AxisModel& model, const AxisPush& push, double substep) {
  Impulse impulse(push);
  std::vector<double> places;
  places.reserve(push.reads.size());
  double time = push.reads.front(), x = push.places.front(), v = 0.0;
  double before = impulse.until(time - model.delay);
  const double mobility = 1.0 / model.mass;
  for (const double read : push.reads) {
    const int steps = static_cast<int>(std::ceil((read - time) / substep - 1e-6));
    const double begin = time - model.delay, h = steps > 0 ? (read - time) / steps : 0.0;
    const double kept = std::exp(-h * model.damping * mobility);
    const double rubs = h * model.friction * mobility;
    for (int i = 1; i <= steps; ++i) {
      const double pushed = impulse.until(begin + i * h);
      v = kept * v + (pushed - before) * mobility;
      before = pushed;
      v -= std::clamp(v, -rubs, rubs);
      x += h * v;
    }
    time = read;
    places.push_back(x);
  }
  return places;
}

AxisFit fit_axis(const std::vector<AxisPush>& pushes, double period, double longest_delay) {
  std::vector<Descent> starts;
  for (const double delay : {0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 0.95}) {
    for (const double mass : {0.03, 0.1, 0.3, 1.0}) {
      for (const double damping : {0.3, 2.0}) {
        for (const double friction : {0.0, 0.1}) {
          const Parameters start(std::log(mass), damping, friction, delay * longest_delay);
          starts.push_back({start, residuals(pushes, start, kCoarse * period).squaredNorm()});
        }
      }
    }
  }
  std::ranges::sort(starts, {}, &Descent::cost);
  Descent best;
  for (std::size_t i = 0; i < kDescents; ++i) {
    const Descent one = descend(pushes, starts[i].place, kCoarse * period, longest_delay);
    if (one.cost < best.cost) best = one;
  }
  best = search_about(pushes, best, period, longest_delay);
  const double substep = kFine * period;
  best = descend(pushes, best.place, substep, longest_delay);
  const Eigen::VectorXd at = residuals(pushes, best.place, substep);
  const Eigen::MatrixXd J = slopes(pushes, best.place, at, substep);
  const Eigen::Matrix4d information = J.transpose() * J + 1e-18 * Eigen::Matrix4d::Identity();
  AxisFit fit;
  fit.model = model_of(best.place);
  fit.residual = std::sqrt(at.squaredNorm() / static_cast<double>(at.size()));
  fit.damping_error = fit.residual * std::sqrt(information.inverse()(1, 1));
  return fit;
}

}  // namespace reckon::haptics

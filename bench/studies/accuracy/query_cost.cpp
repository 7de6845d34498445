// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/query_cost.hpp"

#include <vector>

#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::bench {
namespace {

using deadreckon::KinematicState;
using deadreckon::MotionSample;
using deadreckon::Pose;
using Eigen::Vector3d;

constexpr int kRounds = 41;
constexpr int kQueries = 200;  // of one block

/// A turning, accelerating entity.
MotionSample entity(double time) {
  MotionSample sample;
  sample.time = time;
  sample.position = {20 * time, time * time, 0};
  sample.velocity = {20, 2 * time, 0};
  sample.acceleration = {0, 2, 0};
  sample.angular_velocity = {0.01, 0.02, 0.2};
  return sample;
}

/// A convergence that lasts for the whole measurement.
deadreckon::PoseConvergence converging(deadreckon::ConvergenceCurve curve) {
  deadreckon::ConvergenceSettings settings;
  settings.curve = curve;
  deadreckon::PoseConvergence convergence(settings);
  Pose predicted, shown;
  shown.position = {0.1, 0.2, 0};
  shown.velocity = {0.3, 0, 0};
  convergence.restart(shown, predicted, 0);
  return convergence;
}

/// CPU time of a query [ns] in one block; `predict` returns the pose at a time after the update.
template <typename Predict>
double block(const deadreckon::PoseConvergence& convergence, Predict&& predict, double& sum) {
  return cpu_ns_of([&] {
           for (int i = 0; i < kQueries; ++i) {
             const double now = 1e-4 * i;
             sum += convergence.shown(predict(now), now).position.x();
           }
         }) /
         kQueries;
}

}  // namespace

double QueryCosts::of(const PoseResult& result, Prediction prediction,
                      deadreckon::ConvergenceCurve curve) const {
  const auto column = static_cast<std::size_t>(curve);
  if (prediction == Prediction::adaptive) return adaptive[column];
  double sum = 0, updates = 0;
  for (std::size_t model = 0; model < kModelCount; ++model) {
    sum += static_cast<double>(result.by_model[model]) * as_sent[model][column];
    updates += static_cast<double>(result.by_model[model]);
  }
  return updates > 0 ? sum / updates : 0;
}

QueryCosts measure_query_costs() {
  deadreckon::AdaptiveOrder order;
  for (const double time : {-0.4, -0.2, 0.0}) order.add(entity(time));
  std::array<std::array<std::vector<double>, QueryCosts::kCurves>, kModelCount + 1> blocks;
  double sum = 0;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t curve = 0; curve < QueryCosts::kCurves; ++curve) {
      const auto convergence = converging(deadreckon::kConvergenceCurves[curve].curve);
      for (std::size_t model = 0; model < kModelCount; ++model) {
        const KinematicState state =
            kinematic_state(entity(0), static_cast<pdu::DeadReckoningAlgorithm>(model));
        blocks[model][curve].push_back(block(
            convergence, [&](double tau) { return extrapolate(state, tau); }, sum));
      }
      blocks[kModelCount][curve].push_back(block(
          convergence, [&](double tau) { return order.predict(tau); }, sum));
    }
  }
  // The sum of all results is used, so that the compiler cannot remove any query.
  QueryCosts costs;
  if (!(sum < 1e300)) return costs;
  for (std::size_t curve = 0; curve < QueryCosts::kCurves; ++curve) {
    for (std::size_t model = 0; model < kModelCount; ++model)
      costs.as_sent[model][curve] = median(blocks[model][curve]);
    costs.adaptive[curve] = median(blocks[kModelCount][curve]);
  }
  return costs;
}

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/device_acceptance.hpp"

#include <Eigen/Core>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "reckon/bench/linear_systems/positive_real.hpp"

namespace reckon::bench {
namespace {

using Eigen::MatrixXd;

constexpr int kSearchRounds = 40;  // of the search for the least damper
constexpr double kMargin = 1e-6;   // of the device's damping, kept in reserve
constexpr double kNoise = 1e-9;    // of the model: added against rounding

MatrixXd number(double value) { return MatrixXd::Constant(1, 1, value); }

template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream out;
  (out << ... << parts);
  return out.str();
}

// B (x_k - x_{k-1})/T: the state is x_{k-1}.
StateSpace damper(double damping, double sample_period) {
  const double gain = damping / sample_period;
  return {number(0.0), number(1.0), number(-gain), number(gain), sample_period};
}

// (3.5) is -Re of H T/(z - 1): a held position is one sample behind its speed.
PositiveRealReport judged(const StateSpace& sampled) {
  const StateSpace position{number(1.0), number(sampled.sample_period), number(1.0), number(0.0),
                            sampled.sample_period};
  return judge_positive_real(series(position, sampled));
}

void check(const StateSpace& model, const RenderingDevice& device) {
  if (!(device.damping > 0.0) || !std::isfinite(device.damping) || !(device.sample_period > 0.0) ||
      !std::isfinite(device.sample_period)) {
    throw std::invalid_argument(text("acceptance: a device of ", device.damping, " N s/m and ",
                                     device.sample_period, " s; give numbers > 0"));
  }
  if (model.is_sampled() || model.inputs() != 1 || model.outputs() != 1) {
    throw std::invalid_argument(text("acceptance: the model has ", model.inputs(), " inputs, ",
                                     model.outputs(), " outputs, sample period ",
                                     model.sample_period, " s; give a continuous one of one axis"));
  }
}

}  // namespace

// The needed damping is convex in the damper, so that Newton's steps from below never pass the
// least damper.
Acceptance accepted(const StateSpace& position_to_force, const RenderingDevice& device) {
  check(checked(position_to_force), device);
  const double T = device.sample_period, allowed = device.damping * (1.0 - kMargin);
  const StateSpace sampled = discretise_zero_order_hold(position_to_force, T);
  Acceptance answer;
  StateSpace model = sampled;
  PositiveRealReport need = judged(model);
  answer.required = -need.least;
  answer.angular_frequency = need.angular_frequency;
  for (int round = 0; round < kSearchRounds && !(-need.least <= device.damping); ++round) {
    const double relief = std::cos(need.angular_frequency * T);
    if (!std::isfinite(need.least) || !(relief > 1e-6)) break;
    answer.added_damping += (-need.least - allowed) / relief;
    model = parallel(sampled, damper(answer.added_damping, T));
    need = judged(model);
  }
  const std::string needs = text("needs ", answer.required, " N s/m of the device at ",
                                 answer.angular_frequency, " rad/s, it has ", device.damping);
  if (!(-need.least <= device.damping)) {
    answer.added_damping = 0.0;
    answer.remark =
        text("acceptance: the model ", needs, ", and a damper beside it does not help; ",
             "lower its stiffness, or render it faster");
    return answer;
  }
  if (answer.added_damping > 0.0) {
    answer.remark =
        text("the model ", needs, "; ", answer.added_damping, " N s/m of direct damping is added");
  }
  answer.model = model;
  return answer;
}

PassiveImpedance nearest_passive(const StateSpace& speed_to_force) {
  PassiveImpedance answer;
  const PositiveRealReport report = judge_positive_real(speed_to_force);
  if (!std::isfinite(report.least)) {
    answer.remark = text("passive impedance: ", describe(report),
                         "; no damping mends that, choose another operating point");
    return answer;
  }
  answer.model = speed_to_force;
  if (report.is_positive_real()) return answer;
  answer.added_damping = -report.least * (1.0 + kNoise);
  answer.model->D.diagonal().array() += answer.added_damping;
  answer.remark = text("passive impedance: ", describe(report), "; ", answer.added_damping,
                       " N s/m of direct damping is added");
  return answer;
}

}  // namespace reckon::bench

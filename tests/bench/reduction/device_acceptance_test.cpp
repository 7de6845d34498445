// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/device_acceptance.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "reckon/bench/reduction/balanced_reduction.hpp"
#include "reckon/bench/reduction/congruence_reduction.hpp"
#include "reckon/tests/bench/support/linear_systems.hpp"
#include "reckon/tests/bench/support/membranes.hpp"

namespace reckon::bench {
namespace {

using Eigen::MatrixXd;
using ::testing::HasSubstr;

MatrixXd number(double value) { return MatrixXd::Constant(1, 1, value); }

// Thesis (3.5) from the definition, over a sweep.
double swept_need(const StateSpace& sampled, int count) {
  const double T = sampled.sample_period;
  double need = -HUGE_VAL;
  for (int i = 1; i <= count; ++i) {
    const double angle = std::numbers::pi * i / count;
    const std::complex<double> z = std::polar(1.0, angle);
    const std::complex<double> force = (1.0 - std::conj(z)) * evaluate(sampled, z)(0, 0);
    need = std::max(need, T / (2.0 * (1.0 - std::cos(angle))) * force.real());
  }
  return need;
}

StateSpace spring(double stiffness) { return static_gain(number(stiffness), 0.0); }

TEST(DeviceAcceptance, SpringNeedsItsClosedForm) {
  // b > K T/2.
  const Acceptance soft = accepted(spring(1000.0), {0.6, 1e-3});
  EXPECT_TRUE(soft.model);
  EXPECT_NEAR(soft.required, 0.5, 1e-9);
  EXPECT_EQ(soft.added_damping, 0.0);
  EXPECT_EQ(soft.remark, "");
  // A damper reduces the need of slow motion by as much as it increases the need of fast motion.
  const Acceptance stiff = accepted(spring(1000.0), {0.4, 1e-3});
  EXPECT_FALSE(stiff.model);
  EXPECT_THAT(stiff.remark, HasSubstr("it has 0.4"));
  EXPECT_THAT(stiff.remark, HasSubstr("lower its stiffness"));
}

// A mode with a wrong sign, but only a slow one: parallel damping corrects it.
TEST(DeviceAcceptance, AddsTheLeastSufficientDamper) {
  const double active = 0.7, rate = 20.0;
  StateSpace model{number(-rate), number(rate), number(active * rate), number(100.0), 0.0};
  const RenderingDevice device{0.5, 1e-3};
  const Acceptance answer = accepted(model, device);
  ASSERT_TRUE(answer.model) << answer.remark;
  EXPECT_GT(answer.required, device.damping);
  EXPECT_GT(answer.added_damping, 0.0);
  EXPECT_THAT(answer.remark, HasSubstr("of direct damping is added"));
  EXPECT_LE(swept_need(*answer.model, 20000), device.damping * (1 + 1e-9));
  // One hundredth less is not sufficient.
  const double less = 0.99 * answer.added_damping / device.sample_period;
  const StateSpace damper{number(0), number(1), number(-less), number(less), device.sample_period};
  const StateSpace weaker =
      parallel(discretise_zero_order_hold(model, device.sample_period), damper);
  EXPECT_GT(swept_need(weaker, 20000), device.damping);
}

// Positive real, least real part 0.0166; with its fast mode replaced by the static gain it
// generates energy.
TEST(DeviceAcceptance, DetectsAModelMadeActiveByReduction) {
  StateSpace full{MatrixXd::Zero(2, 2), MatrixXd::Ones(2, 1), MatrixXd(1, 2), number(0.1), 0.0};
  full.A.diagonal() << -1.0, -10.0;
  full.C << 1.0, -1.5;
  const PassiveImpedance as_it_is = nearest_passive(full);
  ASSERT_TRUE(as_it_is.model);
  EXPECT_EQ(as_it_is.added_damping, 0.0);
  EXPECT_EQ(as_it_is.remark, "");

  const StateSpace reduced = residualised(full, 1);
  EXPECT_NEAR(reduced.D(0, 0), -0.05, 1e-12);
  const PassiveImpedance mended = nearest_passive(reduced);
  ASSERT_TRUE(mended.model);
  EXPECT_NEAR(mended.added_damping, 0.05, 1e-6);
  EXPECT_THAT(mended.remark, HasSubstr("of direct damping is added"));

  StateSpace unstable = reduced;
  unstable.A(0, 0) = 1.0;
  EXPECT_FALSE(nearest_passive(unstable).model);
}

// Reductions of random models, stiff and soft, passive and not.
TEST(DeviceAcceptance, AcceptedModelsNeverNeedMoreThanTheDevice) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> unit(0, 1);
  int kept = 0, mended = 0, refused = 0;
  for (int round = 0; round < 10000; ++round) {
    StateSpace model;
    if (round % 2 == 0) {
      model = BalancedReduction(test::random_stable(random, 2 + round % 3)).model(1 + round % 2);
      const double size = std::pow(10.0, 3.5 * unit(random));
      model.C *= size / 10.0;
      model.D *= size;
    } else {
      const auto body = test::make_chain(3 + round % 3, 0.01 + 0.05 * unit(random),
                                         3000 * unit(random) + 100, 300, 5 * unit(random), 1e-3);
      const BodyReduction reduction(body, Basis::krylov);
      model = force_of_displacement(reduction.model(round % 3), 3000 * unit(random) + 100);
    }
    const RenderingDevice device{0.1 + 2 * unit(random), 1e-3};
    const Acceptance answer = accepted(model, device);
    ASSERT_EQ(answer.model.has_value(), answer.remark.empty() || answer.added_damping > 0.0);
    if (!answer.model) {
      ++refused;
      ASSERT_GT(answer.required, device.damping);
      continue;
    }
    ++(answer.added_damping > 0.0 ? mended : kept);
    ASSERT_LE(swept_need(*answer.model, 400), device.damping * (1 + 1e-9)) << "round " << round;
  }
  std::printf("as they were %d, with a damper %d, refused %d\n", kept, mended, refused);
  EXPECT_GT(kept, 1000);
  EXPECT_GT(mended, 100);
  EXPECT_GT(refused, 1000);
}

TEST(DeviceAcceptance, RefusesInvalidDevicesAndModels) {
  EXPECT_THROW((void)accepted(spring(1.0), {0.0, 1e-3}), std::invalid_argument);
  EXPECT_THROW((void)accepted(static_gain(number(1.0), 1e-3), {1.0, 1e-3}), std::invalid_argument);
  EXPECT_THROW((void)accepted(static_gain(MatrixXd::Ones(2, 2), 0.0), {1.0, 1e-3}),
               std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench

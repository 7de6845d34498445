// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/contact_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace reckon::bench {
namespace {

using ::testing::HasSubstr;

// A hand that presses and trembles: 4 mm, 1 mm at 3 Hz, 0.3 mm at 11 Hz.
ContactSample moment(double time, const ContactCoefficients& wall) {
  ContactSample at{time};
  at.depth = 4e-3 + 1e-3 * std::sin(18.8 * time) + 3e-4 * std::sin(69.0 * time);
  at.rate = 18.8e-3 * std::cos(18.8 * time) + 207e-4 * std::cos(69.0 * time);
  at.force = wall.force(at.depth, at.rate);
  return at;
}

std::vector<ContactSample> recorded(const ContactCoefficients& wall, double from, double to) {
  std::vector<ContactSample> samples;
  for (double time = from; time < to; time += 1e-3) samples.push_back(moment(time, wall));
  return samples;
}

TEST(ContactFit, FindsTheCoefficientsOfSamples) {
  const ContactCoefficients wall{300.0, 4e6, 0.2};
  const ContactFit fit = fit_contact(recorded(wall, 0.0, 0.3), {});
  EXPECT_NEAR(fit.contact.k1, wall.k1, 1e-4 * wall.k1);
  EXPECT_NEAR(fit.contact.k3, wall.k3, 1e-4 * wall.k3);
  EXPECT_NEAR(fit.contact.damping, wall.damping, 1e-4);
  EXPECT_EQ(fit.binding, "");
  EXPECT_TRUE(fit.worth_sending());
  EXPECT_LE(fit.error, 1e-4);
}

// The full model: exponential stiffening and a damper that grows with depth.
double full_force(const ContactSample& at) {
  return 0.8 * (std::exp(250.0 * at.depth) - 1.0) + 60.0 * at.depth * at.rate;
}

TEST(ContactFit, StaysUnderItsErrorThenFallsBack) {
  constexpr double kThreshold = 0.03;  // [N]
  const ContactCoefficients fallback{100.0, 0.0, 0.0};
  int used = 0;
  for (double now = 0.3; now < 3.0; now += 0.17) {
    std::vector<ContactSample> samples = recorded({}, now - 0.3, now);
    for (ContactSample& at : samples) at.force = full_force(at);
    const ContactFit fit = fit_contact(samples, {.horizon = 0.1});
    ASSERT_TRUE(fit.worth_sending());
    const ExpiringContact contact(fit, now, fallback);
    for (double time = now; time <= now + 0.1; time += 1e-3) {
      const ContactSample at = moment(time, {});
      EXPECT_NEAR(contact.at(time, at.depth).force(at.depth, at.rate), full_force(at), kThreshold);
      ++used;
    }
    EXPECT_EQ(contact.at(now + 0.1011, 4e-3).k1, fallback.k1);
    EXPECT_EQ(contact.at(now - 1e-3, 4e-3).k1, fallback.k1);
    // Deeper than any sample: unknown.
    EXPECT_EQ(contact.at(now, 1.01 * fit.deepest).k1, fallback.k1);
  }
  EXPECT_GT(used, 1000);
}

TEST(ContactFit, IsPassiveOnTheDeviceForAnySamples) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 2000; ++round) {
    std::vector<ContactSample> samples;
    const double size = std::pow(10.0, 4 * unit(random));
    for (int i = 0; i < 40; ++i) {
      samples.push_back(
          {i * 1e-3, 5e-3 * unit(random), 0.1 * normal(random), size * normal(random)});
    }
    const FitLimits limits{.device_damping = 0.1 + unit(random), .sample_period = 1e-3};
    const ContactFit fit = fit_contact(samples, limits);
    EXPECT_GE(fit.contact.k1, 0.0);
    EXPECT_GE(fit.contact.k3, 0.0);
    EXPECT_GE(fit.contact.damping, 0.0);
    EXPECT_LE(fit.contact.damping, 0.5 * limits.device_damping * (1 + 1e-6));
    // Thesis (3.8), (3.9): b > K T/2 + B, at the steepest point.
    EXPECT_LE(fit.contact.stiffness(fit.deepest) * limits.sample_period / 2 + fit.contact.damping,
              limits.device_damping);
  }
}

double weighted_squares(const std::vector<ContactSample>& samples,
                        const ContactCoefficients& with) {
  double sum = 0.0;
  for (const ContactSample& at : samples) {
    const double miss =
        with.k1 * at.depth + with.k3 * std::pow(at.depth, 3) + with.damping * at.rate - at.force;
    sum += std::exp((at.time - samples.back().time) / 0.1) * miss * miss;
  }
  return sum;
}

// Stiffer than the device can render, so that limits bind; no fit within them is nearer.
TEST(ContactFit, IsTheNearestFitWithinItsLimits) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(0, 1);
  const FitLimits limits{.device_damping = 1.0, .sample_period = 1e-3};
  for (const ContactCoefficients& wall :
       {ContactCoefficients{4000.0, 0, 0.1}, ContactCoefficients{300.0, 5e7, 0.9},
        ContactCoefficients{200.0, 1e5, 2.0}}) {
    const std::vector<ContactSample> samples = recorded(wall, 0.0, 0.3);
    const ContactFit fit = fit_contact(samples, limits);
    EXPECT_NE(fit.binding, "");
    const double least = weighted_squares(samples, fit.contact);
    for (int trial = 0; trial < 20000; ++trial) {
      // All over the limits, and close by.
      ContactCoefficients other{2000 * unit(random), 3e7 * unit(random), 0.5 * unit(random)};
      if (trial % 2 == 0) {
        const auto moved = [&](double at) { return at * (0.98 + 0.04 * unit(random)); };
        other = {moved(fit.contact.k1), moved(fit.contact.k3), moved(fit.contact.damping)};
      }
      const double need = other.stiffness(fit.deepest) + kStiffnessShare * 2000 * other.damping;
      if (other.damping > 0.5 || need > kStiffnessShare * 2000) continue;
      EXPECT_GE(weighted_squares(samples, other), least * (1 - 1e-6));
    }
  }
}

TEST(ContactFit, IsNotSentIfAHeldForceSuffices) {
  std::vector<ContactSample> samples = recorded({}, 0.0, 0.3);
  // A force independent of the depth.
  for (ContactSample& at : samples) at.force = 2.0 + 0.01 * std::sin(900 * at.time);
  const ContactFit fit = fit_contact(samples, {});
  EXPECT_FALSE(fit.worth_sending()) << fit.error << " N, held " << fit.hold_error;
  // Nor a fit with a sampled time shorter than its horizon.
  EXPECT_FALSE(fit_contact(recorded({300.0, 0, 0}, 0.0, 0.05), {}).worth_sending());
}

TEST(ContactFit, RefusesInvalidSamplesAndLimits) {
  std::vector<ContactSample> samples = recorded({300.0, 0, 0}, 0.0, 0.3);
  EXPECT_THROW((void)fit_contact({}, {}), std::invalid_argument);
  EXPECT_THROW((void)fit_contact(samples, {.device_damping = 0.0}), std::invalid_argument);
  samples[7].force = std::nan("");
  try {
    (void)fit_contact(samples, {});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("sample 7 is not finite"));
  }
}

}  // namespace
}  // namespace reckon::bench

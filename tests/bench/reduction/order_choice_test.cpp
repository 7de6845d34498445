// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/order_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "reckon/tests/bench/support/linear_systems.hpp"
#include "reckon/tests/bench/support/membranes.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::bench {
namespace {

using ::testing::HasSubstr;

constexpr double kHz = 2.0 * 3.141592653589793;

// Greatest value over (0, band], by brute force: a dense grid, then three times a denser one around
// each of its three greatest local maxima.
double greatest(const std::function<double(double)>& of, double band) {
  double most = 0.0;
  struct Peak {
    double value, low, high;
  };
  std::vector<Peak> at{{0.0, 1e-4 * band, band}};
  for (int level = 0; level < 4; ++level) {
    std::vector<Peak> next;
    for (const Peak& span : at) {
      const int count = level == 0 ? 500 : 40;
      const double ratio = std::pow(span.high / span.low, 1.0 / (count - 1));
      std::vector<double> w, values;
      for (int i = 0; i < count; ++i) {
        w.push_back(span.low * std::pow(ratio, i));
        values.push_back(of(w.back()));
        most = std::max(most, values.back());
      }
      for (int i = 0; i < count; ++i) {
        const std::size_t k = static_cast<std::size_t>(i);
        const std::size_t before = k == 0 ? 0 : k - 1, after = std::min(k + 1, w.size() - 1);
        if (values[k] < values[before] || values[k] < values[after]) continue;
        next.push_back({values[k], w[before], w[after]});
      }
    }
    std::sort(next.begin(), next.end(), [](auto& a, auto& b) { return a.value > b.value; });
    next.resize(std::min<std::size_t>(next.size(), 3));
    at = next;
  }
  return most;
}

double error_of(const StateSpace& full, const StateSpace& model, const InputRange& range) {
  const auto difference = [&](double w) {
    const std::complex<double> s(0.0, w);
    return std::abs(evaluate(full, s)(0, 0) - evaluate(model, s)(0, 0));
  };
  return range.amplitude * greatest(difference, kHz * range.band_hz);
}

double drawn(std::mt19937& random, double low, double high) {
  return low * std::pow(high / low, std::uniform_real_distribution<double>(0, 1)(random));
}

// Thresholds above and below the errors of all orders.
TEST(OrderChoice, IsTheLeastOrderForRandomSystems) {
  std::mt19937 random(11);
  const int rounds = test::tries(120, 500);
  int chosen = 0;
  for (int round = 0; round < rounds; ++round) {
    const StateSpace full = test::random_stable(random, 2 + round % 8);
    const BalancedReduction reduction(full);
    const InputRange range{drawn(random, 1e-3, 1e-2), drawn(random, 1.0, 100.0)};
    const double threshold =
        range.amplitude * reduction.hankel_values()[0] * drawn(random, 1e-4, 1.0);
    const OrderChoice<StateSpace> choice = choose_order(reduction, range, threshold);
    int least = reduction.least_order();
    double error = 0.0;
    for (; least <= reduction.most_order(); ++least) {
      error = error_of(full, reduction.model(least), range);
      if (error <= threshold) break;
    }
    ASSERT_TRUE(choice.model) << choice.refusal;
    ASSERT_EQ(choice.order, least) << "round " << round << ", " << error << " of " << threshold;
    EXPECT_NEAR(choice.error, error, 1e-4 * error + 1e-12);
    EXPECT_LE(choice.error, choice.bound * (1 + 1e-9) + 1e-12);
    ++chosen;
  }
  EXPECT_EQ(chosen, rounds);
}

TEST(OrderChoice, IsTheLeastModeCountForRandomBodies) {
  std::mt19937 random(12);
  const int rounds = test::tries(120, 500);
  int refused = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto body =
        test::make_chain(2 + round % 8, drawn(random, 0.005, 0.05), drawn(random, 200, 5000),
                         drawn(random, 50, 500), drawn(random, 0.5, 20), drawn(random, 1e-4, 1e-2));
    const Basis basis = round % 2 == 0 ? Basis::krylov : Basis::snapshots;
    const BodyReduction reduction(body, basis);
    const InputRange range{3e-3, drawn(random, 3.0, 100.0)};
    const double stiffness = drawn(random, 200, 1500);
    const double threshold = range.amplitude * stiffness * drawn(random, 1e-4, 0.3);
    const auto choice = choose_order(reduction, range, stiffness, threshold);
    const StateSpace full = test::pressed(body, stiffness);
    int least = 0;
    for (; least <= reduction.most_modes(); ++least) {
      const ModalForceModel model = reduction.model(least);
      bool light = false;
      for (int i = 0; i < least; ++i) light = light || damping_ratio(model, i) < 0.15;
      if (light && least <= 2) continue;
      if (error_of(full, force_of_displacement(model, stiffness), range) <= threshold) break;
    }
    if (least > reduction.most_modes()) {
      EXPECT_FALSE(choice.model);
      EXPECT_NE(choice.refusal, "");
      ++refused;
      continue;
    }
    ASSERT_TRUE(choice.model) << choice.refusal;
    ASSERT_EQ(choice.order, least) << "round " << round;
    EXPECT_EQ(choice.model->modes(), least);
    EXPECT_LE(choice.error, choice.bound * (1 + 1e-9) + 1e-12);
  }
  // Two lightly damped masses have no third mode to take.
  EXPECT_LE(refused, rounds / 5);
}

TEST(OrderChoice, BoundsTheErrorAtAllFrequencies) {
  const auto body = test::make_membrane({.side = 6});
  const BodyReduction reduction(body);
  const auto choice = choose_order(reduction, {3e-3, 20.0}, 900.0, 0.1);
  ASSERT_TRUE(choice.model) << choice.refusal;
  EXPECT_LE(choice.error, 0.1);
  const double beyond =
      3e-3 * test::largest_difference(test::pressed(body, 900.0),
                                      force_of_displacement(*choice.model, 900.0), 1e-2, 1e6, 1.02);
  EXPECT_LE(beyond, choice.bound * (1 + 1e-3));
  EXPECT_GE(choice.bound, choice.error);
}

// A square of equal masses has its modes in pairs, which a damper at one corner separates a little:
// two frequencies that are equal but for rounding once hid the peak between them and their
// neighbour.
TEST(OrderChoice, ErrorIsTheGreatestForPairsOfModes) {
  SecondOrderSystem body = test::make_membrane({.side = 6});
  body.D.coeffRef(0, 0) += 0.01;
  const BodyReduction reduction(body);
  const InputRange range{3e-3, 30.0};
  const auto choice = choose_order(reduction, range, 900.0, 0.1);
  EXPECT_FALSE(choice.model);
  const StateSpace full = test::pressed(body, 900.0);
  for (int order = 3; order <= reduction.most_modes(); ++order) {
    const double error =
        error_of(full, force_of_displacement(reduction.model(order), 900.0), range);
    EXPECT_LE(choice.error, error * (1 + 1e-6)) << order;
    if (order == choice.order) {
      EXPECT_NEAR(choice.error, error, 1e-6 * error);
    }
  }
}

// Waves in a long chain with little damping: no small model approximates it.
TEST(OrderChoice, RefusesWithTheNumberAndTheRemedy) {
  const auto chain = test::make_chain(40, 0.01, 4000.0, 400.0, 0.05, 1e-6);
  const auto choice = choose_order(BodyReduction(chain), {3e-3, 100.0}, 900.0, 1e-3);
  EXPECT_FALSE(choice.model);
  EXPECT_THAT(choice.refusal, HasSubstr("no order up to 16 keeps the force within 0.001 N"));
  EXPECT_THAT(choice.refusal, HasSubstr(" Hz; the nearest, "));
  EXPECT_THAT(choice.refusal, HasSubstr("narrow the band"));
  EXPECT_GT(choice.error, 1e-3);
  EXPECT_THROW((void)choose_order(BodyReduction(chain), {3e-3, 0.0}, 900.0, 1e-3),
               std::invalid_argument);
  EXPECT_THROW((void)choose_order(BalancedReduction(test::oscillator(0.5)), {3e-3, 10.0}, -1.0),
               std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench

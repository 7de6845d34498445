// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/thesis_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "reckon/bench/analysis/device_damping.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::bench {
namespace {

constexpr auto kWith = SpringReading::with_period;
constexpr auto kWithout = SpringReading::without_period;

OneUserScene alone(SpringReading reading, int order = 1) {
  OneUserScene scene;
  scene.reading = reading;
  scene.order = order;
  return scene;
}

TwoUserScene together(SpringReading reading, double other = 1.0) {
  TwoUserScene scene;
  scene.pair.reading = reading;
  scene.push[1] = other;
  return scene;
}

SceneSample fastest(const std::vector<SceneSample>& series) {
  return *std::max_element(series.begin(), series.end(),
                           [](const auto& a, const auto& b) { return a.velocity < b.velocity; });
}

SceneSample strongest(const std::vector<SceneSample>& series) {
  return *std::max_element(series.begin(), series.end(),
                           [](const auto& a, const auto& b) { return a.force < b.force; });
}

// Rows of numbers after one line of names.
std::vector<std::vector<double>> read_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    std::vector<double>& row = rows.emplace_back();
    for (double value = 0; text >> value;) row.push_back(value);
  }
  return rows;
}

TEST(ThesisScenes, OneUserWithThePeriodInTheSpring) {
  const std::vector<SceneSample> series = run(alone(kWith));
  EXPECT_NEAR(fastest(series).velocity, 1.050, 5e-4);
  EXPECT_NEAR(fastest(series).time, 2.52, 1e-9);
  EXPECT_NEAR(strongest(series).force, 1.060, 5e-4);
  EXPECT_NEAR(series.back().force, 0.997, 5e-4);
  EXPECT_LT(std::abs(series.back().velocity), 0.02) << "a steady 0.2 there is not";
}

TEST(ThesisScenes, OneUserWithoutThePeriod) {
  const std::vector<SceneSample> series = run(alone(kWithout));
  EXPECT_NEAR(fastest(series).velocity, 0.2022, 5e-5) << "the 0.2 of the thesis is a peak";
  EXPECT_NEAR(fastest(series).time, 0.34, 1e-9);
  EXPECT_NEAR(strongest(series).force, 1.810, 5e-4);
  EXPECT_LT(std::abs(series.back().velocity), 2e-3);
  EXPECT_EQ(run(alone(kWithout)).back().force, series.back().force) << "to the last bit";
}

TEST(ThesisScenes, PassivityMarginOfTheFirstOrder) {
  EXPECT_NEAR(0.5 - required_device_damping(environment_of(alone(kWith))).required, 0.399, 1e-12);
}

TEST(ThesisScenes, HigherOrdersLoseStabilityAsTheThesisShows) {
  EXPECT_NEAR(loop_radius(alone(kWith, 2)), 0.99701, 1e-4);
  EXPECT_NEAR(loop_radius(alone(kWithout, 2)), 0.9985, 1e-4);
  OneUserScene slow_lag = alone(kWithout, 2);
  slow_lag.lag_pole = 0.8;
  EXPECT_GT(loop_radius(slow_lag), 1.0);
  EXPECT_NEAR(loop_radius(alone(kWith, 3)), 1.0005, 1e-4);
  EXPECT_NEAR(loop_radius(alone(kWithout, 3)), 1.0045, 1e-4);
  EXPECT_NEAR(loop_radius(alone(kWithout, 4)), 1.0015, 1e-4);
  // The guard refuses them: no device damping suffices.
  for (const int order : {3, 4}) {
    EXPECT_TRUE(
        std::isinf(required_device_damping(environment_of(alone(kWithout, order))).required));
  }
}

TEST(ThesisScenes, EnvelopeGrowsByTheRadius) {
  OneUserScene scene = alone(kWithout, 3);
  scene.duration = 40;
  const std::vector<SceneSample> series = run(scene);
  double half = 0, full = 0;
  for (const SceneSample& s : series) {
    double& peak = s.time < 20 ? half : full;
    if (s.time > 15 && (s.time < 20 || s.time > 35)) peak = std::max(peak, std::abs(s.velocity));
  }
  EXPECT_NEAR(std::log(full / half) / 2000, std::log(loop_radius(scene)), 5e-5);
}

// A free mass thrown at a sampled one-sided spring: it returns faster, unless the device's damping
// dissipates the energy of (3.8).
TEST(ThesisScenes, OneSidedWallReturnsUndissipatedEnergy) {
  OneUserScene scene;
  scene.mass = 0.1, scene.stiffness = 1000, scene.wall_damping = 0;
  scene.sample_period = 1e-3;
  scene.push = 0, scene.duration = 0.2;
  scene.start = {-0.01, 0.5};
  scene.wall = 0.0;
  for (const double b : {0.0, 0.5 * 1000 * 1e-3}) {
    scene.damping = b;
    const std::vector<SceneSample> series = run(scene);
    double in = 0, out = 0;
    for (std::size_t k = 1; k < series.size(); ++k) {
      EXPECT_TRUE(series[k].position > 0 || series[k].force == 0) << "it never pulls";
      // From the last sample outside: the spring also owes the energy of the entry within a sample.
      if (series[k].force > 0 && series[k - 1].force == 0) in = series[k - 1].velocity;
      if (series[k].force == 0 && series[k - 1].force > 0) out = -series[k].velocity;
    }
    ASSERT_GT(out, 0);
    const double made = 0.5 * scene.mass * (out * out - in * in);
    if (b == 0) {
      EXPECT_GT(made, 1e-4);
    } else {
      EXPECT_LT(made, 0) << "K T/2 is enough";
    }
  }
}

TEST(ThesisScenes, TwoPushingUsersReachTwoAndFourTenths) {
  const auto series = run(together(kWithout));
  EXPECT_NEAR(series.back()[0].velocity, 2.000, 5e-4) << "1/(b + K_e d)";
  EXPECT_NEAR(series.back()[0].force, 0.400, 5e-4);
  EXPECT_EQ(series.back()[0].velocity, series.back()[1].velocity);
  TwoUserScene late = together(kWithout);
  late.pair.delay_samples = 2;
  late.duration = 60;
  EXPECT_NEAR(run(late).back()[0].velocity, 1 / (0.3 + 0.4), 5e-4);
  EXPECT_NEAR(run(together(kWith)).back()[0].velocity, 3.303, 5e-4);
}

TEST(ThesisScenes, ReducedEnvironmentReachesOneAndAQuarter) {
  // 1/(b + K/(1 - alpha)): K = 0.2, alpha = 0.6.
  const TransferFunction simple = one_pole_environment(0.2, 1.0, 0.6, 0.01);
  const auto series = run(together(kWithout), simple);
  EXPECT_NEAR(series.back()[0].velocity, 1.250, 5e-4);
}

TEST(ThesisScenes, InvalidScenesAreRefused) {
  EXPECT_THROW((void)run(alone(kWith, 5)), std::invalid_argument);
  OneUserScene still = alone(kWith);
  still.sample_period = 0;
  EXPECT_THROW((void)run(still), std::invalid_argument);
  TwoUserScene early;
  early.pair.delay_samples = -1;
  EXPECT_THROW((void)run(early), std::invalid_argument);
}

TEST(ThesisScenes, EveryReferenceSeriesMatchesSampleBySample) {
  RECKON_NEED_DATA("oracles/thesis/standalone_I1.csv");
  const std::filesystem::path folder = test::reference_data() / "oracles/thesis";
  int rows = 0;
  for (const auto& [reading, name] : {std::pair{kWith, "I1"}, std::pair{kWithout, "I2"}}) {
    const std::vector<SceneSample> series = run(alone(reading));
    for (const auto& row : read_csv(folder / (std::string("standalone_") + name + ".csv"))) {
      const SceneSample& s = series.at(static_cast<std::size_t>(std::lround(row[0] / 0.01)));
      EXPECT_NEAR(s.velocity, row[1], 1e-11) << name << " at " << row[0];
      EXPECT_NEAR(s.force, row[2], 1e-11) << name << " at " << row[0];
      EXPECT_NEAR(s.position, row[3], 1e-11) << name << " at " << row[0];
      ++rows;
    }
    for (const int other : {0, 1}) {
      const auto both = run(together(reading, other));
      const std::string file = std::string("network_") + name + "_f2_" + std::to_string(other);
      for (const auto& row : read_csv(folder / (file + ".csv"))) {
        const auto& s = both.at(static_cast<std::size_t>(std::lround(row[0] / 0.01)));
        EXPECT_NEAR(s[0].velocity, row[1], 1e-10) << file << " at " << row[0];
        EXPECT_NEAR(s[1].velocity, row[2], 1e-10) << file << " at " << row[0];
        EXPECT_NEAR(s[0].force, row[3], 1e-10) << file << " at " << row[0];
        EXPECT_NEAR(s[1].force, row[4], 1e-10) << file << " at " << row[0];
        ++rows;
      }
    }
  }
  EXPECT_GT(rows, 500);
}

}  // namespace
}  // namespace reckon::bench

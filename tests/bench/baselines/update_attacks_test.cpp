// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Coefficients that change on a moving hand, out of step with it: the complete receiver under each
// attack that defeats a peer which applies updates as they arrive.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "reckon/bench/baselines/coupling_end.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::bench {
namespace {

constexpr double kPassive = -1e-9;  // [J], rounding of sums of some joules

struct Attack {
  double T, b, f, amplitude, mean, phase, switch_hz, switch_phase;
  Tangent one, other;
  int steps;

  [[nodiscard]] double position(int i) const {
    return mean + amplitude * std::sin(2 * std::numbers::pi * f * i * T + phase);
  }
  [[nodiscard]] double speed(int i) const {
    const double w = 2 * std::numbers::pi * f;
    return w * amplitude * std::cos(w * i * T + phase);
  }
  [[nodiscard]] const Tangent& model(int i) const {
    const double turns = i * T * switch_hz + switch_phase;
    return turns - std::floor(turns) < 0.5 ? one : other;
  }
};

Attack read(const nlohmann::json& v) {
  return {v["T"],       v["b"],         v["f_hz"],         v["x_amp"],          v["x_mean"],
          v["x_phase"], v["switch_hz"], v["switch_phase"], {v["K1"], v["x01"]}, {v["K2"], v["x02"]},
          v["steps"]};
}

nlohmann::json read_oracle() {
  std::ifstream file(test::reference_data() / "oracles/update_attacks.json");
  return nlohmann::json::parse(file);
}

struct Books {
  double work = 0, least_work = 0, least = 0, peak = 0;
};

// The hand moves as prescribed; an update arrives every sample, at once.
Books suffer(const Attack& a, CouplingMode mode) {
  CouplingEndConfig config;
  config.mode = mode;
  config.period = a.T;
  config.damping = a.b;
  const auto end = make_coupling_end(config);
  Books books;
  double damping = 0;
  for (int i = 0; i < a.steps; ++i) {
    const auto number = static_cast<std::uint32_t>(i);
    CouplingSample update;
    update.number = number;
    update.position = a.model(i).surface;
    update.stiffness = a.model(i).stiffness;
    const double force = end->step({number, a.position(i), a.speed(i)}, {&update, 1});
    const double dx = a.position(i + 1) - a.position(i);
    books.work -= force * dx;
    damping += a.b * dx * dx / a.T;
    books.least_work = std::min(books.least_work, books.work);
    books.least = std::min(books.least, books.work + damping);
    books.peak = std::max(books.peak, std::abs(force));
  }
  return books;
}

TEST(UpdateAttacks, DefeatPrintedDeadReckoningByTheStatedEnergy) {
  RECKON_NEED_DATA("oracles/update_attacks.json");
  const nlohmann::json oracle = read_oracle();
  int defeated = 0;
  for (const auto& v : oracle["vectors"]) {
    const Books books = suffer(read(v), CouplingMode::printed_dead_reckoning);
    const std::string id = v["id"];
    const auto& raw = v["raw"];
    EXPECT_NEAR(books.work, raw["port_energy_end"].get<double>(), 1e-9) << id;
    EXPECT_NEAR(books.least_work, raw["port_energy_min"].get<double>(), 1e-9) << id;
    EXPECT_NEAR(books.least, raw["min_with_device_damping"].get<double>(), 1e-9) << id;
    EXPECT_NEAR(books.peak, raw["force_peak"].get<double>(), 1e-9) << id;
    if (books.least < kPassive) ++defeated;
  }
  EXPECT_EQ(defeated, 11);
}

TEST(UpdateAttacks, MakeNoEnergyInTheServo) {
  RECKON_NEED_DATA("oracles/update_attacks.json");
  const nlohmann::json oracle = read_oracle();
  int vectors = 0;
  double least = 0, strongest = 0;
  for (const auto& v : oracle["vectors"]) {
    const Books books = suffer(read(v), CouplingMode::reckon);
    const std::string id = v["id"];
    const double raw_peak = v["raw"]["force_peak"];
    EXPECT_GE(books.least, kPassive) << id;
    EXPECT_LE(books.peak, 1.05 * raw_peak) << id;
    EXPECT_GT(books.peak, 0.2 * raw_peak) << id << ": there is a surface to feel";
    ++vectors;
    least = std::min(least, books.least);
    strongest = std::max(strongest, books.peak / raw_peak);
  }
  EXPECT_EQ(vectors, 16);
  std::printf("%d attacks: at least %.1e J, at most %.2f of the raw peak\n", vectors, least,
              strongest);
}

}  // namespace
}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands of two peers at one body create no energy, in random scenes over random networks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "reckon/tests/integration/two_peers_one_body.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

constexpr int kScenes = 7, kLines = 9;
constexpr double kNoLedger = 1e6;  // [J], a loan so large that ledgers have no effect

class Drawn {
 public:
  explicit Drawn(int number) : random_(static_cast<std::uint32_t>(number)), number_(number) {}

  /// Repeated pushes from both sides; a press; a carry; a lift by friction; two that hold; one that
  /// holds and one that presses; strokes across the line of the press.
  OneBody scene() {
    const int kind = number_ % kScenes;
    OneBody body;
    body.seconds = 5.0;
    body.mass = std::array{0.05, 0.2, 1.0}[static_cast<std::size_t>(kind + number_ / kScenes) % 3];
    body.side = body.mass < 0.1 ? 0.04 : 0.08;
    body.stiffness = any(200, 500);
    body.is_heavy = kind >= 3 && kind < 6;
    body.grab = kind == 4 || kind == 5 ? any(50, 170) : 0.0;
    const double gap = any(0, 0.3), deep = body.mass < 0.1 ? 0.008 : any(0.005, 0.025);
    const double raised = any(0.03, 0.08), swing = any(0, 0.03), rate = any(0.3, 2.0);
    const double half = body.half();
    const auto law = [=](double side, double later) {
      return [=](double t) {
        haptics::HandTarget target;
        double apart = half + 0.06 - (0.06 + deep) * eased(t, 0.2 + later, 0.9 + later);
        double along = 0.0;
        const double busy = eased(t, 1.6, 2.1);
        if (kind == 0) along = -side * 0.05 * std::max(0.0, std::sin(2 * M_PI * rate * t));
        if (kind == 2 || kind == 3) along = swing * std::sin(2 * M_PI * rate * t) * busy;
        target.position = {side * apart + along, 0, body.is_heavy ? half : 0.0};
        if (kind == 6) target.position.y() = side * swing * std::sin(2 * M_PI * rate * t) * busy;
        if (body.is_heavy) target.position.z() += raised * eased(t, 1.8, 2.8);
        const bool holds = kind == 4 || (kind == 5 && side < 0);
        target.buttons = holds && t > 1.4 && t < 4.2 ? 1 : 0;
        return target;
      };
    };
    body.laws = {law(-1, 0.0), law(1, gap)};
    return body;
  }

  /// Delays from 0.3 to 100 ms, without and with 30 % of loss, and outages of 2 and 8 s.
  OneBodyLine line(OneBody& body) {
    const auto kind = static_cast<std::size_t>(number_ / kScenes % kLines);
    OneBodyLine line;
    line.delay = std::array{0.0003, 0.02, 0.05, 0.1}[kind % 4];
    line.loss = kind >= 4 ? 0.3 : 0.0;
    line.seed = static_cast<std::uint64_t>(number_ + 1);
    line.late = number_ % 2 == 0 ? 0.05 : 0.0;
    if (kind == 8) {
      const double begin = any(0.5, 3.0), length = number_ / kScenes % 2 == 0 ? 2.0 : 8.0;
      line.outage = {begin, begin + length};
      body.seconds = begin + length + 2.0;
    }
    return line;
  }

 private:
  double any(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }

  std::mt19937 random_;
  int number_;
};

struct Least {
  double sum = std::numeric_limits<double>::infinity();  // [J], see least_energy()
  double port = std::numeric_limits<double>::infinity();
};

Least least_of(int number, double loan) {
  Drawn drawn(number);
  OneBody body = drawn.scene();
  OneBodyLine line = drawn.line(body);
  line.loan = loan;
  OneBodyRun run(body, line);
  for (const OneBodyStep& step : run.steps()) {
    EXPECT_LE(step.owners, 1) << number;
    if (step.owners > 1) break;
  }
  return {run.least_energy(), std::min(run.least_port(0), run.least_port(1))};
}

class TouchedEnergy : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Scenes, TouchedEnergy, testing::Range(0, kScenes));

TEST_P(TouchedEnergy, IsNotMadeByHandsOfTwoPeers) {
  const int runs = tries(15, 540);
  int beyond = 0;
  for (int i = 0; i < runs; ++i) {
    const int number = GetParam() + kScenes * i;
    const Least least = least_of(number, haptics::PressingHands::kLoan);
    if (least.sum < -2 * haptics::PressingHands::kLoan - 1e-9) ++beyond;
    EXPECT_GE(least.sum, -0.15) << "run " << number;
    EXPECT_GE(least.port, -1e-9) << "run " << number;
  }
  EXPECT_LE(beyond, runs / 100) << "runs below both loans";
}

// Without ledgers, at least one of these five runs creates more than 0.3 J.
TEST(TouchedEnergyWithoutLedgers, IsMade) {
  double least = 0.0;
  for (const int number : {21, 42, 56, 79, 84})
    least = std::min(least, least_of(number, kNoLedger).sum);
  EXPECT_LT(least, -0.3);
}

}  // namespace
}  // namespace reckon::test

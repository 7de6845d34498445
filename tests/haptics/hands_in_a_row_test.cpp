// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands that press one another slowly feel the forces of springs in a row: against the closed form.
// RECKON_SOAK=1 runs all cells with three seeds, a gate one seed of every third or fifth cell.
#include "reckon/tests/haptics/support/hands_in_a_row.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <numeric>

#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::hands_in_a_row_test {
namespace {

constexpr double kPassive = -1e-9;  // [J]

struct Cell {
  std::size_t hands;
  double stiffness, press, ramp, delay, loss, rate;
};

std::ostream& operator<<(std::ostream& out, const Cell& cell) {
  return out << cell.hands << " hands, " << cell.stiffness << " N/m, " << 1e3 * cell.press
             << " mm in " << cell.ramp << " s, " << 1e3 * cell.delay << " ms, " << 100 * cell.loss
             << " % lost, " << (cell.rate > 0 ? "50 Hz" : "by threshold");
}

// Relative force errors by time, and the largest deviation.
struct Felt {
  double after_1s = 0, after_3s = 0;
  double most = 0;    // largest share
  double apart = 0;   // largest minus smallest share
  bool told = false;  // a hand reports that it renders less stiffness
};

Felt press(const Cell& cell, unsigned seed) {
  RowHands hands;
  hands.count = cell.hands;
  hands.stiffness = cell.stiffness;
  hands.start = -0.02;
  hands.target = [&](std::size_t i, double t) {
    return i == 0 ? -0.02 + smooth((t - 1) / cell.ramp) * (0.02 + cell.press) : 0.0;
  };
  RowLine line;
  line.delay = cell.delay;
  line.loss = cell.loss;
  line.rate_hz = cell.rate;
  // A hand is rendered with the stiffness of its device.
  const auto truth = row_truth(cell.hands, hands.grip, std::min(cell.stiffness, 950.0), cell.press);
  HandsInARow row(hands, line, seed);
  std::vector<double> early(cell.hands), late(cell.hands);
  int early_steps = 0, late_steps = 0;
  while (row.time() < 1 + cell.ramp + 5) {
    row.step();
    const double held = row.time() - 1 - cell.ramp;
    const bool is_early = held > 1 && held<1.5, is_late = held> 3;
    early_steps += is_early;
    late_steps += is_late;
    for (std::size_t i = 0; i < cell.hands; ++i) {
      if (is_early) early[i] += row.felt(i);
      if (is_late) late[i] += row.felt(i);
    }
  }
  EXPECT_GE(row.least_sum(), kPassive) << cell;
  EXPECT_GE(row.least_port(), kPassive) << cell;
  Felt felt;
  std::vector<double> shares;
  for (std::size_t i = 0; i < cell.hands; ++i) {
    felt.after_1s = std::max(felt.after_1s, std::abs(early[i] / early_steps / truth[i] - 1));
    felt.after_3s = std::max(felt.after_3s, std::abs(late[i] / late_steps / truth[i] - 1));
    felt.told |= row.snapshot(i).softening < 1 && row.snapshot(i).tally.softened.seconds > 0;
    shares.push_back(late[i] / late_steps / truth[i]);
  }
  const auto [least, most] = std::minmax_element(shares.begin(), shares.end());
  felt.most = *most;
  felt.apart = *most - *least;
  return felt;
}

struct Grid {
  int thinned = 3, first = 0;  // a gate runs one cell in so many, from the first on
  std::vector<std::size_t> hands{2};
  std::vector<double> stiffness{500}, presses{0.01, 0.02, 0.04}, ramps{5, 1};
  std::vector<double> delays{0, 0.0003, 0.005, 0.02, 0.05}, losses{0, 0.3}, rates{0, 50};
};

template <typename Visit>
void each(const Grid& grid, Visit&& visit) {
  test::Thinned thinned(grid.thinned, grid.first);
  for (const std::size_t n : grid.hands)
    for (const double k : grid.stiffness)
      for (const double press : grid.presses)
        for (const double ramp : grid.ramps)
          for (const double delay : grid.delays)
            for (const double loss : grid.losses)
              for (const double rate : grid.rates) {
                if (thinned.skips()) continue;
                for (unsigned seed = 1; seed <= test::tries(1U, 3U); ++seed)
                  visit(Cell{n, k, press, ramp, delay, loss, rate}, seed);
              }
}

TEST(SlowPress, TwoHandsFeelTheSpringsInSeries) {
  Felt worst;
  int cells = 0, off = 0;
  each(Grid{}, [&](const Cell& cell, unsigned seed) {
    const Felt felt = press(cell, seed);
    ++cells;
    worst.after_1s = std::max(worst.after_1s, felt.after_1s);
    worst.after_3s = std::max(worst.after_3s, felt.after_3s);
    if (felt.after_3s <= 0.03 && felt.after_1s <= 0.10) return;
    ++off;
    std::cout << "off by " << felt.after_3s << ": " << cell << ", seed " << seed << "\n";
  });
  std::printf("%d of %d runs off; worst after 1 s %.3f, after 3 s %.3f\n", off, cells,
              worst.after_1s, worst.after_3s);
  EXPECT_EQ(off, 0);
}

// If the energy of two stiff hands is short, both ends render the contact softer, and report it.
TEST(SlowPress, StiffHandsAreCorrectOrSoftenedAlike) {
  Grid grid;
  grid.stiffness = {900};
  int cells = 0, not_alike = 0;
  each(grid, [&](const Cell& cell, unsigned seed) {
    const Felt felt = press(cell, seed);
    ++cells;
    EXPECT_LE(felt.most, 1.1) << cell << ", seed " << seed;
    if (felt.after_3s <= 0.10) return;
    EXPECT_TRUE(felt.told) << cell << ", seed " << seed;
    if (felt.apart <= 0.05) return;
    ++not_alike;
    std::cout << "apart by " << felt.apart << ": " << cell << ", seed " << seed << "\n";
    EXPECT_TRUE(cell.rate > 0 && cell.loss > 0) << cell;
  });
  std::printf("%d of %d runs more than 10 %% off and not alike\n", not_alike, cells);
  EXPECT_LE(not_alike, cells / 60);
}

TEST(SlowPress, StiffHandsFeelTheSpringsWithoutLoss) {
  Grid grid;
  grid.stiffness = {900};
  grid.presses = {0.01, 0.02};
  grid.delays = {0, 0.0003, 0.02, 0.05};
  grid.losses = {0};
  each(grid, [&](const Cell& cell, unsigned seed) {
    EXPECT_LE(press(cell, seed).after_3s, test::tries(0.03, 0.05)) << cell << ", seed " << seed;
  });
}

TEST(SlowPress, ThreeAndFourHandsFeelTheSprings) {
  Grid grid;
  grid.hands = {3, 4};
  grid.stiffness = {300, 500};
  grid.presses = {0.02, 0.04};
  if (!test::soaks()) grid.delays = {0.0003, 0.02, 0.05};
  grid.thinned = 5;
  int cells = 0, off = 0;
  each(grid, [&](const Cell& cell, unsigned seed) {
    const Felt felt = press(cell, seed);
    ++cells;
    if (felt.after_3s <= 0.03) return;
    ++off;
    EXPECT_TRUE(felt.told) << cell << ", seed " << seed;
    EXPECT_LE(felt.after_3s, 0.06) << cell << ", seed " << seed;
  });
  std::printf("%d of %d runs more than 3 %% off, all told\n", off, cells);
  EXPECT_LE(off, cells / 400);
}

// Near the energy limit, K = b/T, a row of hands is rendered softer where energy is short, and
// reports it; no hand is ever pushed harder than correct.
TEST(SlowPress, StiffRowsReportWhereTheyAreSoftened) {
  Grid grid;
  grid.hands = {3, 4};
  grid.stiffness = {900};
  grid.presses = {0.02, 0.04};
  int cells = 0, off = 0;
  each(grid, [&](const Cell& cell, unsigned seed) {
    const Felt felt = press(cell, seed);
    ++cells;
    EXPECT_LE(felt.most, 1.1) << cell << ", seed " << seed;
    if (felt.after_3s <= 0.10) return;
    ++off;
    EXPECT_TRUE(felt.told) << cell << ", seed " << seed;
  });
  std::printf("%d of %d runs more than 10 %% off, all told\n", off, cells);
  EXPECT_LE(off, cells / 4);
}

// A blow that carries one hand through the other's centre reverses the correct direction of the
// force. Neither the state before the blow nor a prediction from it may pull in the wrong direction
// for longer than an update takes.
TEST(QuickTap, ForceHasTheRightDirectionSoonAfterCrossing) {
  int cells = 0, crossed = 0, touched = 0, late = 0, late_before = 0;
  for (const double delay : {0.02, 0.03, 0.05, 0.1})
    for (const double radius : {0.01, 0.02})
      for (const double speed : {0.59, 0.88, 1.2})
        for (const double back : {0.0, 1.0})  // stays beyond, or returns to touch
          for (unsigned seed = 1; seed <= test::tries(2U, 10U); ++seed) {
            RowHands hands;
            hands.radius = radius;
            hands.start = -0.02;
            const double way = 0.02 + 7 * radius;  // far beyond the other's centre
            const double rest = (0.02 + 0.006) / way;
            const double span = 1.5 * way / speed;
            hands.target = [&](std::size_t i, double t) {
              if (i > 0) return 0.0;
              const double returned = back * (1 - rest) * smooth((t - 1.3) / span);
              return -0.02 + way * (smooth((t - 1) / span) - returned);
            };
            RowLine line;
            line.delay = delay;
            HandsInARow row(hands, line, seed);
            double crossed_at = 0, side = 1, wrong = 0, wrong_before = 0, felt_for = 0;
            while (row.time() < 4) {
              row.step();
              const double apart = row.device(1).position().x() - row.device(0).position().x();
              if (apart * side < 0) {
                side = -side;
                crossed_at = row.time();
                wrong_before += wrong;
                wrong = 0;
              }
              const double heard = crossed_at + 0.1 + delay;
              if (crossed_at == 0 || row.time() < heard || row.depth(0) < 1e-3) continue;
              const double first = row.snapshot(0).force.x(), second = row.snapshot(1).force.x();
              if (second * side < -0.02 || first * side > 0.02) wrong += 1e-3;
              if (second * side > 0.02 && first * side < -0.02) felt_for += 1e-3;
            }
            ++cells;
            crossed += crossed_at > 0;
            touched += felt_for > 0.5;
            late += wrong > 0.01;
            late_before += wrong_before > 0.01;
            EXPECT_LT(wrong_before, 0.03)
                << delay << " s, " << radius << " m, " << speed << " m/s, seed " << seed;
            EXPECT_GE(row.least_port(), kPassive);
          }
  std::printf("%d of %d cells late, %d before the hands cross again\n", late, cells, late_before);
  EXPECT_EQ(crossed, cells);
  EXPECT_GE(touched, cells / 2);
  EXPECT_EQ(late, 0);
  // Just before a crossing back, the force of a hand with late updates turns some ms too early.
  EXPECT_LE(late_before, cells / 12);
}

// Gain and phase of each hand's force against stiffness times true overlap at that instant.
TEST(Strokes, AreFeltCorrectlyOnALan) {
  for (const double stiffness : {500.0, 800.0}) {
    RowHands hands;
    hands.stiffness = stiffness;
    hands.start = -0.02;
    const double wave = 2 * std::numbers::pi * 1.5;
    hands.target = [&](std::size_t i, double t) {
      if (i > 0) return 0.0;
      return -0.02 + 0.035 * smooth(t - 1) + (t > 2 ? 0.005 * std::sin(wave * (t - 2)) : 0.0);
    };
    RowLine line;
    line.delay = 0.0003;
    HandsInARow row(hands, line, 1);
    std::array<std::complex<double>, 2> felt{};
    std::complex<double> truth;
    double peak = 0, true_peak = 0;
    while (row.time() < 10) {
      row.step();
      const auto turn = std::polar(1.0, -wave * row.time());
      const double force = stiffness * std::max(0.0, row.depth(0));
      if (row.time() < 2) {
        peak = std::max({peak, row.felt(0), row.felt(1)});
        true_peak = std::max(true_peak, force);
      }
      if (row.time() < 4) continue;
      truth += turn * force;
      for (std::size_t i = 0; i < 2; ++i) felt[i] += turn * row.felt(i);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const std::complex<double> ratio = felt[i] / truth;
      const double degrees = std::arg(ratio) * 180 / std::numbers::pi;
      std::printf("%.0f N/m, hand %zu: gain %.3f, phase %+.1f degrees\n", stiffness, i + 1,
                  std::abs(ratio), degrees);
      EXPECT_NEAR(std::abs(ratio), 1.0, 0.1);
      EXPECT_NEAR(degrees, 0.0, 10.0);
    }
    EXPECT_LE(peak, 1.25 * true_peak);
  }
}

TEST(SlowPress, RestingHandsComeToRest) {
  for (const double delay : {0.0003, 0.05}) {
    RowHands hands;
    hands.start = -0.02;
    hands.target = [](std::size_t i, double t) {
      return i == 0 ? -0.02 + smooth(t - 1) * 0.04 : 0.0;
    };
    RowLine line;
    line.delay = delay;
    HandsInARow row(hands, line, 1);
    while (row.time() < 60) row.step();
    const auto truth = row_truth(2, hands.grip, hands.stiffness, 0.02);
    for (std::size_t i = 0; i < 2; ++i) {
      // Unsent changes, 15 mN or 0.03 mm, still move them a little.
      EXPECT_LT(row.device(i).velocity().norm(), 3e-3) << delay;
      EXPECT_NEAR(row.felt(i), truth[i], 0.03 * truth[i]) << delay;
    }
  }
}

}  // namespace
}  // namespace reckon::haptics::hands_in_a_row_test

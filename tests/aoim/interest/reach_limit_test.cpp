// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer with a receive budget among senders: the distance up to which cells stay joined.
#include "reckon/aoim/interest/reach_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr double kSensed = 300.0, kSide = 50.0;  // [m]

/// Received traffic with cells joined up to a distance [B/s].
using Traffic = std::function<double(double reach)>;

// In rings of a cell's side around the own cell.
Traffic even(double per_cell) {
  return [=](double reach) {
    const double rings = std::floor(reach / kSide + 0.5);
    return per_cell * (2 * rings + 1) * (2 * rings + 1);
  };
}

class Thrifty {
 public:
  Thrifty(double budget, Traffic heard)
      : limit_({budget, kSensed, kSide}), heard_(std::move(heard)) {}

  void run(nanoseconds span) {
    for (const nanoseconds end = now_ + span; now_ < end; now_ += 50ms) {
      // Groups are left 2 s after the request and joined at once.
      const double asked = std::min(limit_.cut(), kSensed);
      if (asked >= reach_) reach_ = asked, left_at_ = now_ + 2s;
      if (asked < reach_ && now_ >= left_at_) reach_ = asked;
      if (asked == reach_) left_at_ = now_ + 2s;
      octets_ += 0.05 * heard_(reach_);
      const double before = limit_.cut();
      limit_.note(static_cast<std::uint64_t>(octets_), now_);
      if (limit_.cut() != before) ++changes_;
    }
  }
  void set(Traffic heard) { heard_ = std::move(heard); }
  [[nodiscard]] const ReachLimit& limit() const { return limit_; }
  [[nodiscard]] double hears() const { return heard_(reach_); }
  [[nodiscard]] int take_changes() { return std::exchange(changes_, 0); }

 private:
  ReachLimit limit_;
  Traffic heard_;
  double reach_ = kSensed, octets_ = 0;
  nanoseconds now_{0}, left_at_{0};
  int changes_ = 0;
};

TEST(ReachLimit, LeavesTrafficWithinTheBudgetAlone) {
  Thrifty peer(1e6, even(100));
  peer.run(10min);
  EXPECT_FALSE(peer.limit().is_cut());
  EXPECT_EQ(peer.take_changes(), 0);
}

TEST(ReachLimit, MeetsTheBudgetWithinHalfAMinute) {
  for (const double share : {0.9, 0.5, 0.25, 0.1, 0.03, 0.01}) {
    const double whole = even(100)(kSensed);
    Thrifty peer(share * whole, even(100));
    int seconds = 0;
    for (; !(peer.limit().is_cut() && peer.limit().is_met()) && seconds < 60; ++seconds)
      peer.run(1s);
    EXPECT_LE(seconds, 30) << share;
    EXPECT_LE(peer.hears(), share * whole) << share;
    peer.run(1min);
    double sum = 0;
    for (int second = 0; second < 180; ++second) {
      peer.run(1s);
      sum += peer.hears();
    }
    // One more ring adds up to three quarters of the traffic of the inner ones.
    EXPECT_GT(sum / 180, 0.25 * share * whole) << share;
    EXPECT_LT(sum / 180, 1.1 * share * whole) << share;
  }
}

TEST(ReachLimit, KeepsTheOwnCellAndReportsUnmetBudgets) {
  Thrifty peer(8000, [](double reach) { return reach > 0 ? 60000.0 : 49000.0; });
  peer.run(1min);
  EXPECT_EQ(peer.limit().cut(), 0.0);
  EXPECT_TRUE(peer.limit().is_unmet());
  EXPECT_NEAR(peer.limit().heard(), 49000.0, 1.0);
}

TEST(ReachLimit, RestoresTheReachWhenTheCrowdHasLeft) {
  Thrifty peer(5000, even(100));
  peer.run(1min);
  ASSERT_TRUE(peer.limit().is_cut());
  peer.set(even(1));
  peer.run(4min);
  EXPECT_FALSE(peer.limit().is_cut());
}

// A crowd is just beyond the reach that fits. Each attempt to widen the reach costs more, so
// attempts become rare.
TEST(ReachLimit, TriesToWidenEverLessOften) {
  Thrifty peer(10'000, [](double reach) { return reach < 100.0 ? 1000.0 : 90'000.0; });
  peer.run(2min);
  ASSERT_TRUE(peer.limit().is_cut());
  static_cast<void>(peer.take_changes());
  peer.run(20min);
  EXPECT_LE(peer.take_changes(), 2 * 20 * 60 / 160 + 2) << "out and back";
  EXPECT_LT(peer.limit().cut(), 125.0);
}

TEST(ReachLimit, IsNotMovedByASecondOfNewcomers) {
  Thrifty peer(20'000, even(10));
  peer.run(1min);
  for (int i = 0; i < 20; ++i) {
    peer.set([](double) { return 300'000.0; });
    peer.run(1s);
    peer.set(even(10));
    peer.run(6s);
  }
  EXPECT_EQ(peer.take_changes(), 0);
}

TEST(ReachLimit, MeetsTheBudgetInRandomWorlds) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(0, 1);
    std::vector<std::pair<double, double>> senders;  // distance, rate
    for (int i = static_cast<int>(1 + 200 * u(random)); i > 0; --i)
      senders.emplace_back(kSensed * std::sqrt(u(random)), std::pow(10.0, 4 * u(random)));
    const Traffic heard = [senders](double reach) {
      double sum = 0;
      for (const auto& [distance, rate] : senders) sum += distance <= reach + kSide ? rate : 0;
      return sum;
    };
    const double budget = heard(kSensed) * std::pow(10.0, -3 * u(random)) + 1;
    Thrifty peer(budget, heard);
    peer.run(2min);
    int above = 0;
    for (int second = 0; second < 600; ++second) {
      peer.run(1s);
      above += peer.hears() > budget ? 1 : 0;
    }
    if (heard(0) > budget) {
      EXPECT_TRUE(peer.limit().is_unmet()) << "seed " << seed;
    } else {
      EXPECT_LT(above, 60) << "seed " << seed << ": looks for more room";
    }
  }
}

TEST(ReachLimit, RestartsWithTheByteCount) {
  ReachLimit limit({1000, kSensed, kSide});
  limit.note(1'000'000'000, 1s);
  limit.note(0, 20s);
  limit.note(100, 40s);
  limit.note(200, 60s);
  EXPECT_FALSE(limit.is_cut());
  EXPECT_LT(limit.heard(), 100.0);
}

}  // namespace
}  // namespace reckon::aoim

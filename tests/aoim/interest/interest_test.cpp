// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/interest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

namespace reckon::aoim {
namespace {

TEST(Interest, AgreesWithBruteForceOnRandomScenes) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> where(-100.0, 100.0), radius(0.0, 80.0);
  for (int scene = 0; scene < 1000; ++scene) {
    std::vector<Focus> foci(1 + random() % 5);
    for (Focus& focus : foci)
      focus = {{where(random), where(random), where(random)}, 0.0, radius(random)};
    Interest interest({});
    ASSERT_EQ(interest.set_foci(foci), foci.size());
    for (int i = 0; i < 50; ++i) {
      const Position p{where(random), where(random), where(random)};
      const double nimbus = radius(random) * 0.2;
      bool inside = false, near = false;
      for (const Focus& focus : foci) {
        const double x = p.x - focus.position.x, y = p.y - focus.position.y;
        const double z = p.z - focus.position.z;
        const double away = std::sqrt(x * x + y * y + z * z) - nimbus;
        inside = inside || away <= focus.radius;
        near = near || away <= 1.1 * focus.radius;
      }
      const auto fresh = interest.judge(p, nimbus, 1, false);
      const auto shown = interest.judge(p, nimbus, 1, true);
      ASSERT_EQ(fresh, inside ? InterestVerdict::inside : InterestVerdict::outside);
      ASSERT_EQ(shown, inside ? InterestVerdict::inside
                       : near ? InterestVerdict::lingering
                              : InterestVerdict::left);
    }
  }
}

TEST(Interest, HidesEntitiesBeyondAuraOrBehindABox) {
  InterestConfig config;
  config.aura = 60.0;
  config.occluders = {{{4, -1, -1}, {5, 1, 1}}};
  Interest interest(config);
  const Focus focus{{0, 0, 0}, 0.0, 50.0};
  interest.set_foci({&focus, 1});
  EXPECT_EQ(interest.judge({3, 0, 0}, 0, 1, false), InterestVerdict::inside);
  for (const bool shown : {false, true})
    EXPECT_EQ(interest.judge({9, 0, 0}, 0, 1, shown), InterestVerdict::hidden);
  EXPECT_EQ(interest.judge({9, 3, 0}, 0, 1, false), InterestVerdict::inside) << "beside the box";
  EXPECT_EQ(interest.judge({-59, 10, 0}, 20, 1, false), InterestVerdict::inside);
  EXPECT_EQ(interest.judge({-62, 10, 0}, 20, 1, false), InterestVerdict::hidden);
  EXPECT_EQ(interest.judge({-62, 10, 0}, 20, 1, true), InterestVerdict::inside)
      << "until 1.1 of it";
  EXPECT_EQ(interest.judge({-67, 10, 0}, 20, 1, true), InterestVerdict::hidden);
  EXPECT_EQ(interest.counts().hidden, 4u);
  EXPECT_GT(interest.gap({9, 0, 0}, 0), 0.0);
  EXPECT_LT(interest.gap({9, 0, 0}, 0), 1.0);
  EXPECT_LT(interest.gap({9, 3, 0}, 0), 0.0);
  EXPECT_EQ(interest.distance_to_focus({3, 4, 0}), 5.0);
}

TEST(Interest, CountsEveryVerdictOnce) {
  InterestConfig config;
  config.kinds = 1u << 1;
  Interest interest(config);
  const Focus focus{{0, 0, 0}, 0.0, 10.0};
  interest.set_foci({&focus, 1});
  interest.judge({5, 0, 0}, 0, 1, false);
  interest.judge({10.5, 0, 0}, 0, 1, true);
  interest.judge({12, 0, 0}, 0, 1, true);
  interest.judge({12, 0, 0}, 0, 1, false);
  interest.judge({5, 0, 0}, 0, 2, false);
  interest.judge({std::numeric_limits<double>::quiet_NaN(), 0, 0}, 0, 1, false);
  const InterestCounts& counts = interest.counts();
  EXPECT_EQ(counts.accepted, 1u);
  EXPECT_EQ(counts.lingering, 1u);
  EXPECT_EQ(counts.left, 1u);
  EXPECT_EQ(counts.outside, 1u);
  EXPECT_EQ(counts.class_off, 1u);
  EXPECT_EQ(counts.not_finite, 1u);
}

TEST(Interest, DoesNotFlickerAtTheEdge) {
  Interest interest({});
  const Focus focus{{0, 0, 0}, 0.0, 100.0};
  interest.set_foci({&focus, 1});
  bool shown = false;
  int flips = 0;
  for (int i = 0; i < 1000; ++i) {
    const bool now = is_accepted(interest.judge({99.0 + 4.0 * (i % 2), 0, 0}, 0, 1, shown));
    flips += now != shown ? 1 : 0;
    shown = now;
  }
  EXPECT_EQ(flips, 1);
}

TEST(Interest, RemembersTheNearestEntityOutside) {
  Interest interest({});
  constexpr double kNone = std::numeric_limits<double>::infinity();
  interest.judge({5, 0, 0}, 0, 1, false);
  EXPECT_EQ(interest.take_nearest_outside(), kNone) << "without a focus nothing is near";
  const std::array<Focus, 2> foci{{{{0, 0, 0}, 0.0, 2.0}, {{100, 0, 0}, 0.0, 2.0}}};
  interest.set_foci(foci);
  interest.judge({100, 0, 3000}, 500, 1, false);
  interest.judge({0, 4000, 0}, 0, 1, false);
  interest.judge({0, 1, 0}, 0, 1, false);      // inside
  interest.judge({0, 9, 0}, 0, 1, true);       // left
  interest.judge({0, kNone, 0}, 0, 1, false);  // not finite
  EXPECT_EQ(interest.take_nearest_outside(), 2500.0);
  EXPECT_EQ(interest.take_nearest_outside(), kNone);
}

// For any change of the foci: an entity with a margin stays shown until the foci have withdrawn by
// that margin.
TEST(Interest, WithdrawalCoversTheMarginOfShownEntities) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> where(-300.0, 300.0), radius(0.0, 250.0), way(-20.0, 20.0);
  std::size_t kept = 0, left = 0;
  for (int scene = 0; scene < 500; ++scene) {
    Interest interest({});
    std::vector<Focus> foci(1 + random() % 4);
    for (Focus& focus : foci) focus = {{where(random), where(random), 0}, 0.0, radius(random)};
    interest.set_foci(foci);
    for (int i = 0; i < 20; ++i) {
      const Position p{where(random), where(random), 0};
      const double before = interest.spare(p, 5.0, 1), due = interest.withdrawn() + before;
      if (!(before > 0.0)) continue;
      if (random() % 8 == 0) foci.resize(1 + random() % 4, foci[0]);  // some foci merge, some split
      for (Focus& focus : foci) {
        focus.position.x += way(random);
        focus.position.y += way(random);
        focus.radius = std::max(0.0, focus.radius + 0.3 * way(random));
      }
      interest.set_foci(foci);
      const bool stays = is_accepted(interest.judge(p, 5.0, 1, true));
      ASSERT_TRUE(stays || interest.withdrawn() >= due * (1.0 - 1e-12)) << "scene " << scene;
      (stays ? kept : left) += 1;
      const double margin =
          interest.judge(p, 5.0, 1, false) == InterestVerdict::inside ? interest.margin() : 0.0;
      ASSERT_GE(interest.spare(p, 5.0, 1), margin * (1.0 - 1e-12));
    }
    const double withdrawn = interest.withdrawn();
    interest.set_foci(foci);
    EXPECT_EQ(interest.withdrawn(), withdrawn) << "they stand";
  }
  EXPECT_GT(kept, 500U);
  EXPECT_GT(left, 100U);
}

}  // namespace
}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The counted work of bodies in a period is bounded, and which islands pay for that.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/counted_work.hpp"
#include "reckon/haptics/bodies/island_plan.hpp"
#include "reckon/tests/haptics/support/hands_in_a_pile.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::body_budget_test {
namespace {

constexpr double kPeriod = 1e-3;  // [s]

/// Notes the counted work of the bodies when its force is written.
class CountingDevice : public SimulatedDevice {
 public:
  using SimulatedDevice::SimulatedDevice;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override {
    if (world != nullptr) written = world->work();
    SimulatedDevice::write(force, now);
  }
  const BodyWorld* world = nullptr;
  double written = 0.0;
};

/// Greatest counted work of a period [s].
struct Most {
  double before_force = 0.0, whole = 0.0;
};

Most most_work(int boxes, int hands, double pace, unsigned seed) {
  test::HandsInAPile<CountingDevice> pile(boxes, hands, seed);
  pile.world->set_pace(pace);
  pile.devices.back()->world = pile.world.get();
  Most most;
  for (int i = 0; i < test::tries(3000, 20'000); ++i) {
    const double begin = pile.world->work();
    pile.step();
    most.before_force = std::max(most.before_force, pile.devices.back()->written - begin);
    most.whole = std::max(most.whole, pile.world->work() - begin);
  }
  return most;
}

// 0.17 of the period for predictions and small steps, half more for one that is broken off, and the
// prediction of the pushed bodies alone; then 0.4 and what collisions take.
TEST(BodyBudget, BoundsTheWorkOfEachPeriod) {
  for (const int boxes : {8, 27, 64}) {
    const Most most = most_work(boxes, 1, 1.0, 3);
    EXPECT_LT(most.before_force, 0.45 * kPeriod) << boxes;
    EXPECT_LT(most.whole, 1.0 * kPeriod) << boxes;
  }
}

TEST(BodyBudget, LeavesASlowHostLessWork) {
  const Most usual = most_work(27, 1, 1.0, 3), slow = most_work(27, 1, 3.0, 3);
  EXPECT_LT(slow.before_force, 0.6 * usual.before_force);
}

TEST(BodyBudget, RepeatsToTheBit) {
  test::HandsInAPile<> one(27, 2), other(27, 2);
  for (int i = 0; i < test::tries(1500, 10'000); ++i) {
    one.step();
    other.step();
  }
  EXPECT_EQ(one.world->work(), other.world->work());
  for (std::size_t i = 0; i < one.world->states().size(); ++i)
    ASSERT_EQ(one.world->states()[i].position, other.world->states()[i].position) << i;
}

/// Islands of `contacts` each, with one body.
std::vector<PlannedIsland> planned(const std::vector<int>& contacts, BodySet pushed,
                                   double seconds) {
  IslandEnergy::Islands islands;
  BodySet bodies = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    islands.add(i, contacts[i]);
    bodies |= BodySet{1} << i;
  }
  IslandPlan plan;
  plan.make(bodies, islands, pushed, seconds);
  return {plan.islands().begin(), plan.islands().end()};
}

TEST(IslandPlan, IsExactWhereTimeAllows) {
  for (const PlannedIsland& island : planned({4, 12, 24}, 0, 1.0)) EXPECT_TRUE(island.is_exact);
  const std::vector<PlannedIsland> large = planned({4, IslandPlan::kMostExact + 1}, 0, 1.0);
  EXPECT_TRUE(large[0].is_exact);
  EXPECT_FALSE(large[1].is_exact);
  EXPECT_EQ(IslandPlan::iterations_of(large[1]), 30);
}

TEST(IslandPlan, GivesThePushedIslandThePrecedence) {
  const double seconds = CountedWork::exact(20) + 2 * CountedWork::iterated(20, 10) + 1e-6;
  const std::vector<PlannedIsland> plan = planned({20, 20, 20}, BodySet{1} << 1, seconds);
  EXPECT_FALSE(plan[0].is_exact);
  EXPECT_TRUE(plan[1].is_exact);
  EXPECT_FALSE(plan[2].is_exact);
}

TEST(IslandPlan, KeepsSmallIslandsExactFirst) {
  const double seconds =
      CountedWork::exact(8) + CountedWork::exact(12) + CountedWork::iterated(24, 10) + 1e-6;
  const std::vector<PlannedIsland> plan = planned({24, 8, 12}, 0, seconds);
  EXPECT_FALSE(plan[0].is_exact);
  EXPECT_TRUE(plan[1].is_exact);
  EXPECT_TRUE(plan[2].is_exact);
}

TEST(IslandPlan, SpendsTheRestOnIterations) {
  int last = 0;
  for (const double seconds : {0.0, 1.5e-4, 2e-4, 1.0}) {
    const std::vector<PlannedIsland> plan = planned({60, 60}, 0, seconds);
    EXPECT_GE(plan[0].iterations, 10);
    EXPECT_GE(plan[0].iterations, last);
    last = plan[0].iterations;
  }
  EXPECT_EQ(last, 30);
}

}  // namespace
}  // namespace reckon::haptics::body_budget_test

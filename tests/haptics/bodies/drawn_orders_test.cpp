// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Drawn sequences of orders to bodies in a box, and the exchange that carries orders.
// RECKON_SOAK=1 draws 1,000 sequences.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/tests/haptics/support/body_table.hpp"
#include "reckon/tests/haptics/support/moved_bodies.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::drawn_orders_test {
namespace {

using Eigen::Vector3d;
using tables::kG;
using tables::MovedBodies;
using tables::Table;

constexpr double kEdge = 0.04, kMass = 0.05, kStepTime = 1e-3;
constexpr double kInertia = kMass * kEdge * kEdge / 6;
constexpr double kParting = 0.1;  // [m/s], speed at which the solver lifts overlapping bodies apart
constexpr std::uint32_t kCubes = 20;

double moving(const ObjectMotion& state) {
  return 0.5 * kMass * state.velocity.squaredNorm() +
         0.5 * kInertia * state.turn_rate.squaredNorm();
}
double energy(const ObjectMotion& state) { return moving(state) + kMass * kG * state.position.z(); }

/// Cubes in a box. Their orders are drawn, and their energy is bounded by what the orders bring.
class Drawn {
 public:
  explicit Drawn(int seed) : random_(static_cast<unsigned>(seed)), mover_(make_mover()) {
    table_.floor({0, 0.5, 0.3});
    table_.within(Vector3d(0.5, 0.5, 2.0), 0.5);
    for (std::uint32_t i = 0; i < kCubes; ++i) table_.box(kEdge, start_of(i), {kMass, 0.5, 0.3});
    table_.begin(mover_);
    for (std::uint32_t i = 0; i < kCubes; ++i) bound_ += energy(table_.state(i));
  }

  /// One period; with an order, if there is one.
  void step(bool with_order) {
    const double before = sum() + (with_order ? order() : 0.0);
    table_.run(kStepTime);
    const double after = sum();
    most_rise_ = std::max(most_rise_, after - before);
    ASSERT_LE(after, bound_ + 1e-9);
    for (std::uint32_t i = 0; i < kCubes; ++i) {
      const BodyState& body = table_.state(i);
      ASSERT_TRUE(body.position.allFinite() && body.velocity.allFinite()) << i;
      ASSERT_GT(body.position.z(), 0.0) << i;
      if (!body.carried) continue;
      ASSERT_LT((body.position - mover_->of(i + 1).position).norm(), 1e-15) << i;
      ASSERT_TRUE(body.velocity.isZero(0.0)) << i;
    }
  }
  /// Greatest growth of the energy in a period, beyond that of its order [J].
  [[nodiscard]] double most_rise() const { return most_rise_; }
  [[nodiscard]] double most_speed() const {
    double most = 0.0;
    for (std::uint32_t i = 0; i < kCubes; ++i)
      most = std::max(most, table_.state(i).velocity.norm());
    return most;
  }

 private:
  static std::shared_ptr<MovedBodies> make_mover() {
    auto out = std::make_shared<MovedBodies>();
    for (std::uint32_t i = 0; i <= kCubes; ++i) static_cast<void>(out->of(i));
    return out;
  }
  double any(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  Vector3d any_vector(double most) {
    return {any(-most, most), any(-most, most), any(-most, most)};
  }
  // With what impacts have lost, as far as it may still lift a body out of another.
  [[nodiscard]] double sum() {
    double sum = table_.world().energy();
    for (std::uint32_t i = 0; i < kCubes; ++i)
      if (!table_.state(i).carried) sum += kMass * kG * start_of(i).z();
    return sum;
  }
  static Vector3d start_of(std::uint32_t cube) {
    return {0.1 * (cube % 4) - 0.15, 0.1 * (cube / 4) - 0.2, 0.03 + 0.001 * cube};
  }
  /// @return the energy that it brings [J]
  double order() {
    BodyOrder order;
    order.body = static_cast<std::uint32_t>(random_() % kCubes);
    order.act = static_cast<BodyAct>(random_() % 5);
    const BodyState& body = table_.state(order.body);
    order.state.position = {any(-0.2, 0.2), any(-0.2, 0.2), any(0.005, 0.4)};
    order.state.orientation = Eigen::AngleAxisd(any(-3, 3), any_vector(1).normalized());
    order.state.velocity = any_vector(2);
    order.state.turn_rate = any_vector(10);
    order.impulse = any_vector(0.1);
    order.point = body.position + any_vector(0.02);
    // The usual case: the body continues where it is.
    if (random_() % 3 == 0) order.state = body;
    EXPECT_TRUE(table_.world().order(order));
    const double had = body.carried ? 0.0 : energy(body);
    const double brought = brings(order, body, had);
    const bool is_put = order.act == BodyAct::own || order.act == BodyAct::place;
    // Overlapping bodies are lifted apart.
    bound_ += brought + (is_put ? 3 * kMass * kG * kEdge : 0.0);
    return brought;
  }
  static double brings(const BodyOrder& order, const BodyState& body, double had) {
    if (order.act == BodyAct::own) return energy(order.state) - had;
    if (body.carried) return 0.0;
    if (order.act == BodyAct::disown) return -had;
    if (order.act == BodyAct::place) return energy(order.state) - had;
    if (order.act != BodyAct::push) return 0.0;
    ObjectMotion pushed = body;
    pushed.velocity += order.impulse / kMass;
    pushed.turn_rate += (order.point - body.position).cross(order.impulse) / kInertia;
    return energy(pushed) - had;
  }

  std::mt19937 random_;
  std::shared_ptr<MovedBodies> mover_;
  Table table_;
  double bound_ = 0.0;  // [J]
  double most_rise_ = 0.0;
};

TEST(DrawnOrders, NeverAddEnergyOrLoseABody) {
  double rise = 0.0;
  for (int seed = 1; seed <= test::tries(40, 1000); ++seed) {
    SCOPED_TRACE(seed);
    Drawn drawn(seed);
    for (int i = 0; i < 600; ++i) {
      drawn.step(i % 7 == 0);
      if (testing::Test::HasFatalFailure()) return;
    }
    for (int i = 0; i < 2500; ++i) drawn.step(false);
    EXPECT_LT(drawn.most_speed(), 0.3);
    rise = std::max(rise, drawn.most_rise());
  }
  std::printf("greatest growth of the energy in a period: %.2g J\n", rise);
  // As if all bodies were lifted apart at one time.
  EXPECT_LT(rise, kCubes * kMass * kG * kParting * kStepTime);
}

TEST(DrawnOrders, CostNoAllocation) {
  Drawn drawn(1);
  for (int i = 0; i < 600; ++i) drawn.step(i % 7 == 0);
  const test::AllocationGuard guard;
  for (int i = 0; i < 600; ++i) drawn.step(i % 7 == 0);
  EXPECT_EQ(guard.count(), 0u);
}

/// A tower of cubes on a floor.
void build_tower(Table& table, int cubes) {
  table.floor({0, 0.5, 0});
  for (int i = 0; i < cubes; ++i) table.box(kEdge, {0, 0, (i + 0.5) * kEdge}, {kMass, 0.5, 0.0});
}

TEST(BodyExchange, TransactionTakesEffectInOneAdvance) {
  Table table;
  for (int i = 0; i < 64; ++i) table.box(kEdge, {0.1 * i, 0, 1}, {kMass, 0.5, 0.0});
  BodyWorld& world = table.begin();
  std::array<BodyOrder, 64> orders;
  for (std::uint32_t i = 0; i < 64; ++i) orders[i] = {BodyAct::disown, i};
  const std::uint64_t serial = world.exchange().send(orders);
  ASSERT_NE(serial, 0u);
  EXPECT_FALSE(table.state().carried);
  table.run(kStepTime);
  EXPECT_EQ(std::ranges::count_if(world.states(), &BodyState::carried), 64);
  ASSERT_TRUE(world.published().update());
  EXPECT_EQ(world.published().read().serial, serial);
  BodyEnd end;
  int ends = 0;
  while (world.exchange().take_end(end)) ends += end.was_owned ? 1 : 0;
  EXPECT_EQ(ends, 64);
}

TEST(BodyExchange, RefusesWhatItCannotAnswer) {
  Table table;
  table.box(kEdge, {0, 0, 1}, {kMass, 0.5, 0.0});
  BodyWorld& world = table.begin();
  std::vector<BodyOrder> orders(65, {BodyAct::disown, 0});
  EXPECT_EQ(world.exchange().send(orders), 0u) << "too many";
  EXPECT_EQ(world.exchange().send({}), 0u);
  orders.pop_back();
  std::uint64_t sent = 0, ends = 0;
  for (int i = 0; i < 100; ++i) {
    sent += world.exchange().send(orders) != 0 ? 64 : 0;
    if (i % 2 == 0) table.run(kStepTime);
  }
  EXPECT_EQ(sent, 16u * 64u) << "nobody takes the answers";
  BodyEnd end;
  while (world.exchange().take_end(end)) ++ends;
  EXPECT_EQ(ends, sent);
  EXPECT_NE(world.exchange().send(orders), 0u);
}

// One thread hands a body over and back, the other one steps it: each answer is the next beginning.
TEST(BodyExchange, HandsOverBetweenThreads) {
  Table table;
  table.box(kEdge, {0, 0, 1}, {kMass, 0.5, 0.0});
  table.without_gravity();
  BodyWorld& world = table.begin();
  ObjectMotion first{{0, 0, 0}, Eigen::Quaterniond::Identity()};
  first.velocity = {0.5, 0, 0};
  world.own(0, first);
  table.run(kStepTime);
  std::atomic<bool> is_done = false;
  std::thread servo([&] {
    while (!is_done) table.run(kStepTime);
  });
  int rounds = 0;
  for (; rounds < 2000; ++rounds) {
    const BodyOrder leave{BodyAct::disown, 0};
    BodyEnd end;
    if (world.exchange().send(std::span(&leave, 1)) == 0) break;
    while (!world.exchange().take_end(end)) std::this_thread::yield();
    if (!end.was_owned || (end.state.velocity - first.velocity).norm() > 1e-12) break;
    const BodyOrder back{BodyAct::own, 0, end.state};
    while (world.exchange().send(std::span(&back, 1)) == 0) std::this_thread::yield();
  }
  is_done = true;
  servo.join();
  EXPECT_EQ(rounds, 2000);
}

TEST(BodyStates, ShowTheContactIslands) {
  Table table;
  build_tower(table, 3);
  table.box(kEdge, {1, 0, 0.5 * kEdge}, {kMass, 0.5, 0.0});
  table.box(kEdge, {0.99 * kEdge, 0, 0.5 * kEdge}, {kMass, 0.5, 0.0});
  BodyWorld& world = table.begin(std::make_shared<MovedBodies>());
  world.disown(4);
  table.run(0.02);
  ASSERT_TRUE(world.published().update());
  const BodyStates& states = world.published().read();
  std::array<std::uint32_t, 8> members{};
  EXPECT_EQ(states.copy_island(1, members), 4u)
      << "the tower, and the carried cube that touches it";
  EXPECT_EQ(members[3], 4u);
  EXPECT_EQ(states.copy_island(3, members), 1u);
  table.run(2.0);
  ASSERT_TRUE(world.published().update());
  EXPECT_EQ(world.published().read().copy_island(1, members), 1u) << "asleep";
}

}  // namespace
}  // namespace reckon::haptics::drawn_orders_test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// For any updates of hands from the network: the servo stays passive, within its limits, and
// deterministic.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
namespace {

using namespace bench;

// All possible statements about a hand, every few milliseconds, to a moving hand.
class Hostile {
 public:
  explicit Hostile(unsigned seed)
      : rng_(seed), bench(floor(600, 0.1), at(0.02), [seed](double t) {
          HandTarget hand;
          const double p = seed;
          hand.position = {0.02 * std::sin(3 * t + p), 0.02 * std::sin(5 * t + 2 * p),
                           0.02 * std::sin(4 * t + 3 * p)};
          return hand;
        }) {}

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      if (unit() < 0.1) bench.servo.contacts().write(set());
      bench.run(1ms);
      const ServoSnapshot& s = bench.servo.snapshots().read();
      finite = finite && s.force.allFinite() && s.velocity.allFinite();
      least_snapshot = std::min(least_snapshot, s.port_energy + s.loan);
      for (std::size_t k = 0; k < s.count; ++k) {
        monotone = monotone && s.contacts[k].given >= 0 && s.contacts[k].received >= 0;
      }
    }
  }

  bool finite = true, monotone = true;
  double least_snapshot = 0;

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(rng_); }
  Vector3d direction() { return Vector3d(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalized(); }
  double evil() {
    const double values[] = {std::nan(""), std::numeric_limits<double>::infinity(), -1e308, 1e308,
                             -5.0};
    return values[static_cast<int>(5 * unit())];
  }

  RemoteHand hand(std::uint16_t entity) {
    RemoteHand h = sphere(0.03 * direction(), 1500 * unit(), ++version_);
    h.id.entity = entity;
    h.state.algorithm = static_cast<pdu::DeadReckoningAlgorithm>(1 + static_cast<int>(9 * unit()));
    h.state.velocity = 0.3 * direction();
    h.state.angular_velocity = 3 * direction();
    h.state.orientation = Eigen::Quaterniond(unit(), unit(), unit(), 1).normalized();
    h.state_time = bench.now - nanoseconds(static_cast<std::int64_t>(2e8 * unit() * unit()));
    h.valid_until = h.state_time + 300ms;
    h.model.kind = static_cast<pdu::ForceModelKind>(static_cast<int>(7 * unit()));
    h.model.k3 = unit() < 0.5 ? 0 : 1e7 * unit();
    h.model.damping = 2 * unit() * unit();
    h.model.static_friction = unit();
    h.model.kinetic_friction = h.model.static_friction * unit();
    h.model.normal = direction();
    h.given_to_us = given_ += unit() < 0.05 ? 0.01 * unit() : 0;
    h.need = unit() < 0.2 ? 0.02 * unit() : 0;
    if (unit() < 0.05) h.epoch = static_cast<std::uint32_t>(3 * unit());
    if (unit() < 0.2) poison(h);
    return h;
  }

  void poison(RemoteHand& h) {
    double* const fields[] = {&h.model.k1,
                              &h.model.k3,
                              &h.model.damping,
                              &h.model.radius,
                              &h.model.point.x(),
                              &h.model.normal.y(),
                              &h.state.position.z(),
                              &h.state.velocity.x(),
                              &h.given_to_us,
                              &h.need,
                              &h.model.static_friction};
    *fields[static_cast<int>(11 * unit())] = evil();
    if (unit() < 0.2) h.valid_until = nanoseconds::max();
    if (unit() < 0.2) h.state_time = nanoseconds::min();
    if (unit() < 0.2) h.state.position += direction();
  }

  ContactSet set() {
    ContactSet s;
    s.count = static_cast<std::size_t>(4 * unit());
    if (unit() < 0.02) s.count = 1000;
    for (std::size_t i = 0; i < 3; ++i) s.hands[i] = hand(static_cast<std::uint16_t>(1 + i));
    if (unit() < 0.05) s.hands[1].id = s.hands[0].id;
    s.frozen = unit() < 0.02;
    return s;
  }

  std::mt19937 rng_;
  std::uint32_t version_ = 0;
  double given_ = 0;

 public:
  Bench bench;
};

TEST(ServoLoop, StaysPassiveAndWithinLimitsUnderHostileUpdates) {
  double least = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Hostile hostile(seed);
    hostile.run(4000);
    ASSERT_TRUE(hostile.finite) << "seed " << seed;
    ASSERT_TRUE(hostile.monotone) << "seed " << seed;
    ASSERT_GE(hostile.least_snapshot, kPassive) << "seed " << seed;
    ASSERT_LE(hostile.bench.peak, 10 + 1e-9) << "seed " << seed;
    least = std::min(least, hostile.least_snapshot);
  }
  std::printf("20 seeds x 4 s of hostile updates: least port energy %.2g J\n", least);
}

TEST(ServoLoop, AllocatesNothingAfterConstruction) {
  Hostile hostile(1);
  TraceRing ring(64);
  hostile.bench.servo.trace(&ring);
  const test::AllocationGuard guard;
  hostile.run(500);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(ServoLoop, GivesTheSameTrajectoryForTheSameInput) {
  const auto end = [] {
    Hostile hostile(9);
    hostile.run(1000);
    return hostile.bench.device.position();
  };
  EXPECT_EQ(end(), end());
}

}  // namespace
}  // namespace reckon::haptics

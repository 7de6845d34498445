// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A servo among the maximum number of hands, servos that share a scene, and a device with any
// position and orientation.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <utility>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::haptics::many_hands_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr double kRadius = 0.02;  // [m], of a remote hand

RemoteHand ball(std::uint16_t entity, const Vector3d& centre, double k1) {
  RemoteHand hand;
  hand.id = {1, 2, entity};
  hand.state.position = centre;
  hand.model.kind = pdu::ForceModelKind::sphere;
  hand.model.k1 = k1;
  hand.model.radius = kRadius;
  hand.valid_until = 1000s;
  hand.version = 1;
  return hand;
}

// n hands about the origin, each pressed in by 1 mm there.
ContactSet crowd(std::size_t n, double k1) {
  ContactSet set;
  set.count = n;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 0.05 * static_cast<double>(i);
    set.hands[i] = ball(static_cast<std::uint16_t>(i),
                        (kRadius + 0.009) * Vector3d(std::cos(angle), std::sin(angle), 0.0), k1);
  }
  return set;
}

SimulatedDeviceConfig held_tight() {
  SimulatedDeviceConfig config;
  config.hand_stiffness = 2000.0;
  return config;
}

HandScript comes_down() {
  return [](double t) {
    HandTarget hand;
    hand.position.z() = std::max(0.0, 0.05 - 0.05 * t);
    return hand;
  };
}

class Bench {
 public:
  explicit Bench(const ServoConfig& config = {}, SimulatedDeviceConfig device_config = held_tight(),
                 HandScript script = comes_down())
      : device(device_config, std::move(script)), servo(device, EffectPlan(), config) {}

  const ServoSnapshot& run(nanoseconds duration) {
    for (const nanoseconds end = now + duration; now < end; now += 1ms) servo.step(now);
    servo.snapshots().update();
    return servo.snapshots().read();
  }

  SimulatedDevice device;
  ServoLoop servo;
  nanoseconds now{0};
};

Vector3d forces_of(const ServoSnapshot& s) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < s.count; ++i) sum += s.contacts[i].force;
  return sum;
}

TEST(ManyHands, EachOfThirtyTwoIsFelt) {
  SimulatedDeviceConfig config = held_tight();
  config.start.z() = 0.05;
  for (const std::size_t n : {std::size_t{9}, kMaxRemoteHands}) {
    Bench bench({}, config);
    const double k1 = 800.0 / static_cast<double>(n);
    const ContactSet set = crowd(n, k1);
    bench.servo.contacts().write(set);
    const ServoSnapshot& s = bench.run(5s);
    ASSERT_EQ(s.count, n);
    EXPECT_EQ(s.left_out, 0u);
    Vector3d expected = Vector3d::Zero();
    for (std::size_t i = 0; i < n; ++i) {
      const Vector3d away = s.device - set.hands[i].state.position;
      const double depth = kRadius + 0.01 - away.norm();
      ASSERT_GT(depth, 0.0) << "hand " << i;
      expected += k1 * depth * away.normalized();
    }
    EXPECT_LT((s.force - expected).norm(), 1e-9);
    EXPECT_LT((s.force - forces_of(s)).norm(), 1e-12);
    EXPECT_GE(s.port_energy_min, -1e-9);
  }
}

TEST(ManyHands, TogetherAreWithinTheDevicesStiffness) {
  SimulatedDeviceConfig config = held_tight();
  config.start.z() = 0.05;
  Bench bench({}, config);
  bench.servo.contacts().write(crowd(kMaxRemoteHands, 1500.0));
  const ServoSnapshot& s = bench.run(5s);
  ASSERT_EQ(s.count, kMaxRemoteHands);
  Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < s.count; ++i) {
    if (!(s.contacts[i].depth > 0)) continue;
    const Vector3d normal = s.contacts[i].force.normalized();
    slopes += s.contacts[i].force.norm() / s.contacts[i].depth * normal * normal.transpose();
  }
  const double stiffness = slopes.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
  const double most = 2 * bench.servo.remote_stiffness_limit();
  EXPECT_LE(stiffness, most * (1 + 1e-9));
  EXPECT_GT(stiffness, 0.9 * most);
  EXPECT_LT(s.device_velocity.norm(), 1e-4) << "at rest";
  EXPECT_GE(s.port_energy_min, -1e-9);
  EXPECT_GE(bench.device.port_work() + bench.device.damping_loss(), -1e-9);
}

TEST(ManyHands, CountsOmittedHands) {
  ServoConfig config;
  config.max_contacts = 5;
  Bench bench(config);
  ContactSet set = crowd(12, 10.0);
  set.left_out = 3;
  bench.servo.contacts().write(set);
  EXPECT_EQ(bench.run(5ms).count, 5u);
  EXPECT_EQ(bench.run(5ms).left_out, 12u - 5u + 3u);
  bench.servo.contacts().write(crowd(5, 10.0));
  EXPECT_EQ(bench.run(5ms).left_out, 0u);
}

// Sets in any order, with hands that come, go and return, more of them than there are accounts.
TEST(ManyHands, LedgerHoldsThroughComingAndGoing) {
  std::mt19937 random(11);
  Bench bench({}, {}, {});
  std::map<std::uint16_t, ContactAccount> last;  // of each hand ever met
  double closed = 0.0;                       // [J], received - given of accounts that were dropped
  std::map<std::uint16_t, double> promised;  // [J], running total of each
  std::uint32_t version = 1;
  for (std::uint32_t round = 0; round < 600; ++round) {
    ContactSet set;
    set.count = random() % (kMaxRemoteHands + 1);
    const auto first = static_cast<std::uint32_t>(random() % 400);
    for (std::size_t i = 0; i < set.count; ++i) {
      const auto entity = static_cast<std::uint16_t>(first + (i * 7 + round) % kMaxRemoteHands);
      set.hands[i] = ball(entity, Vector3d(0.0, 5.0, 1.0), 100.0);
      set.hands[i].version = ++version;
      set.hands[i].given_to_us = promised[entity] += 1e-4 * static_cast<double>(random() % 5);
      set.hands[i].need = 1e-4 * static_cast<double>(random() % 3);
    }
    bench.servo.contacts().write(set);
    const ServoSnapshot& s = bench.run(nanoseconds(1ms) * (1 + random() % 150));
    for (std::size_t i = 0; i < s.count; ++i) {
      const ContactAccount& now = s.contacts[i];
      ContactAccount& before = last[now.id.entity];
      if (now.received < before.received) closed += before.received - before.given;
      before = now;
    }
  }
  EXPECT_GT(closed, 0.005);
  double sum = closed;
  for (const auto& [entity, account] : last) sum += account.received - account.given;
  EXPECT_GT(last.size(), 300u);
  // The hand is at rest and touches nothing: the port has only energy from others.
  const ServoSnapshot& s = bench.run(1ms);
  ASSERT_EQ(bench.device.port_work(), 0.0);
  EXPECT_NEAR(s.port_energy, sum, 1e-12);
}

TEST(SharedPlan, IsSharedAndGivesTheSameResults) {
  Scene scene;
  for (int i = 0; i < 200; ++i) {
    SceneObject object;
    object.name = "a ball with a name that needs the heap";
    object.shape = SphereShape{0.02};
    object.pose.position = {0.1 * i, 0.0, 0.0};
    object.effects.declare<StickSlipFriction>();
    scene.objects.push_back(object);
  }
  const auto plan = std::make_shared<const EffectPlan>(scene);
  SimulatedDevice devices[3] = {SimulatedDevice({}, comes_down()),
                                SimulatedDevice({}, comes_down()),
                                SimulatedDevice({}, comes_down())};
  ServoLoop a(devices[0], plan, {});
  ServoLoop b(devices[1], plan, {});
  ServoLoop own(devices[2], EffectPlan(scene), {});
  EXPECT_EQ(plan.use_count(), 3) << "no copy is made";
  for (nanoseconds now{0}; now < 3s; now += 1ms) {
    // One after the other, and one of them ahead: they do not influence each other.
    a.step(now);
    own.step(now);
    ASSERT_EQ(devices[0].force(), devices[2].force());
    if (now >= 1s) b.step(now - 1s);
  }
  EXPECT_GT(devices[0].force().norm(), 0.5);
  EXPECT_THROW(ServoLoop(devices[1], std::shared_ptr<const EffectPlan>(), {}),
               std::invalid_argument);
}

Scene floor_and_ball() {
  Scene scene;
  SceneObject floor;
  floor.name = "floor";
  floor.shape = PlaneShape{};
  floor.effects.of<SpringDamper>() = {700.0, 0.2};
  floor.effects.declare<StickSlipFriction>();
  SceneObject block;
  block.name = "block";
  block.shape = BoxShape{Vector3d(0.02, 0.02, 0.02)};
  block.pose.position = {0.03, 0.0, 0.01};
  scene.objects = {floor, block};
  return scene;
}

// Path of a hand in S: down to the floor, then to and fro against a block.
Vector3d stroke(double t) {
  return {0.02 * std::sin(3.0 * t), 0.01 * std::sin(5.0 * t), std::max(-0.004, 0.03 - 0.03 * t)};
}

HandTarget target_at(const Vector3d& position) {
  HandTarget target;
  target.position = position;
  return target;
}

TEST(DevicePose, GivesTheSameForcesInTheScene) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond(0.3, -0.5, 0.7, 0.2).normalized();
  const Vector3d shift(2.0, -1.0, 0.5);
  const auto in_device = [&](const Vector3d& p) {
    return Vector3d(turn.conjugate() * (p - shift));
  };
  SimulatedDeviceConfig straight, turned;
  straight.start = stroke(0.0);
  turned.start = in_device(stroke(0.0));
  SimulatedDevice devices[2] = {
      SimulatedDevice(straight, [](double t) { return target_at(stroke(t)); }),
      SimulatedDevice(turned, [&](double t) { return target_at(in_device(stroke(t))); })};
  const ServoConfig posed{.device_origin = shift, .device_orientation = turn};
  ServoLoop plain(devices[0], EffectPlan(floor_and_ball()), {});
  ServoLoop servo(devices[1], EffectPlan(floor_and_ball()), posed);
  RemoteHand hand = ball(7, {0.0, 0.02, 0.0}, 400.0);
  hand.model.damping = 0.2;
  hand.model.static_friction = hand.model.kinetic_friction = 0.3;

  double most = 0.0, felt = 0.0;
  nanoseconds now{0};
  for (int i = 0; i < 5000; ++i, now += i % 1500 == 1499 ? 30ms : 1ms) {  // past the watchdog too
    for (ServoLoop* loop : {&plain, &servo}) {
      if (i % 20 == 0) {
        ContactSet set;
        set.count = 1;
        set.hands[0] = hand;
        set.hands[0].version = static_cast<std::uint32_t>(i + 1);
        loop->contacts().write(set);
      }
      loop->step(now);
      loop->snapshots().update();
    }
    const ServoSnapshot& a = plain.snapshots().read();
    const ServoSnapshot& b = servo.snapshots().read();
    // They differ by rounding only, which contact with friction does not amplify.
    ASSERT_LT((a.device - b.device).norm(), 1e-9) << "step " << i;
    ASSERT_LT((a.scp - b.scp).norm(), 1e-9) << "step " << i;
    ASSERT_LT((a.velocity - b.velocity).norm(), 1e-6) << "step " << i;
    ASSERT_LT((a.device_velocity - b.device_velocity).norm(), 1e-6) << "step " << i;
    ASSERT_LT((a.force - b.force).norm(), 1e-6) << "step " << i;
    ASSERT_LT((devices[1].force() - turn.conjugate() * b.force).norm(), 1e-12) << "step " << i;
    ASSERT_NEAR(a.port_energy, b.port_energy, 1e-9);
    most = std::max(most, a.force.norm());
    felt = std::max(felt, forces_of(a).norm());
  }
  EXPECT_GT(most, 1.0);
  EXPECT_GT(felt, 0.1) << "the remote hand is part of it";
}

}  // namespace
}  // namespace reckon::haptics::many_hands_test

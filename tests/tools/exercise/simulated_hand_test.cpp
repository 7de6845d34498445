// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices made from scenes: their operators, poses and limits.
#include "reckon/tools/exercise/simulated_hand.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::tools {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

constexpr const char* kSweep =
    "[[operator]]\nsweep = { from = \"-60 0 0 mm\", to = \"60 20 0 mm\", period = \"2 s\" }\n";

peer::SceneFile scene(const std::string& text) { return peer::parse_scene_file(text, "x.toml"); }

/// Positions of the free handle at each 10 ms, in S.
std::vector<Vector3d> way(const peer::SceneFile& file, const peer::DeviceConfig& config) {
  const auto device = make_simulated_device(file, config);
  std::vector<Vector3d> points;
  for (auto now = 0ms; now < 2s; now += 10ms) {
    const Vector3d p_D = device->read(now).position;
    points.push_back(config.position + config.orientation * p_D);
  }
  return points;
}

TEST(SimulatedDevice, MovesAlikeInTheSceneInAnyPose) {
  const peer::SceneFile file =
      scene(std::string(kSweep) +
            "[[device]]\n[[device]]\nposition = \"20 -10 5 cm\"\n"
            "heading = \"50 deg\"\npitch = \"20 deg\"\nroll = \"-70 deg\"\n");
  const auto plain = way(file, file.devices[0]), turned = way(file, file.devices[1]);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_LE((turned[i] - plain[i]).norm(), 1e-12) << i;
  }
  EXPECT_GT((plain[100] - plain[0]).norm(), 0.1) << "it moves";
  EXPECT_LE((plain[0] - Vector3d(-0.06, 0, 0)).norm(), 1e-12) << "and starts where its target is";
}

TEST(SimulatedDevice, HasTheLimitsOfItsTable) {
  const peer::SceneFile file =
      scene(std::string(kSweep) +
            "[[device]]\nmax_force = 12\ndamping = 2\nmax_stiffness = 3000\n"
            "max_speed = 0.5\nrate = 2000\ndelay = \"2 ms\"\n");
  const haptics::DeviceLimits limits = make_simulated_device(file, file.devices[0])->limits();
  EXPECT_EQ(limits.max_force, 12);
  EXPECT_EQ(limits.damping, 2);
  EXPECT_EQ(limits.max_stiffness, 3000);
  EXPECT_EQ(limits.max_speed, 0.5);
  EXPECT_EQ(limits.delay_samples, 4);
}

TEST(SimulatedDevice, TurnsAsItsOperatorForAnyDevicePose) {
  const peer::SceneFile file = scene(
      "[[operator]]\nsweep = { from = \"0 0 0 m\", to = \"0.1 0 0 m\", turn = \"0 40 0 deg\", "
      "period = "
      "\"2 s\" }\nturn_stiffness = \"2 N m/rad\"\n"
      "[[device]]\naxes = 6\nmax_torque = \"0.5 N m\"\nturn_damping = \"0.02 N m s/rad\"\n"
      "[[device]]\naxes = 6\nheading = \"50 deg\"\nroll = \"-70 deg\"\n"
      "[[device.probe]]\nposition = \"3 0 0 cm\"\n");
  const haptics::DeviceLimits limits = make_simulated_device(file, file.devices[0])->limits();
  EXPECT_EQ(limits.axes, 6);
  EXPECT_EQ(limits.max_torque, 0.5);
  EXPECT_EQ(limits.turn_damping, 0.02);
  for (const peer::DeviceConfig& config : file.devices) {
    const auto device = make_simulated_device(file, config);
    Eigen::Quaterniond at = Eigen::Quaterniond::Identity();
    for (auto now = 0ms; now <= 1s; now += 1ms) {
      const Eigen::Quaterniond in_device = device->read(now).turn->orientation;
      at = config.orientation * in_device;
      if (now == 0ms) {
        EXPECT_LE(at.angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
      }
    }
    const Eigen::Quaterniond whole(
        Eigen::AngleAxisd(40 * std::numbers::pi / 180, Vector3d::UnitY()));
    EXPECT_LE(at.angularDistance(whole), 0.03) << "within the lag of the grip";
  }
  EXPECT_EQ(probes_of(file.devices[1]), std::vector<Vector3d>{Vector3d(0.03, 0, 0)});
}

TEST(SimulatedDevice, DefaultsToTheHandOfItsNumber) {
  const peer::SceneFile file = scene(kSweep);
  for (std::uint32_t number = 1; number <= 3; ++number) {
    const auto devices = peer::devices_of(file, number);
    ASSERT_EQ(devices.size(), 1u);
    const auto device = make_simulated_device(file, devices[0]);
    const auto hand = make_simulated_hand(file, number - 1);
    EXPECT_EQ(device->position(), hand->position()) << "aside from the third on: " << number;
    EXPECT_EQ(device->limits().max_force, hand->limits().max_force);
    EXPECT_EQ(device->limits().damping, hand->limits().damping);
  }
  EXPECT_NE(make_simulated_hand(file, 0)->position(), make_simulated_hand(file, 1)->position());
}

TEST(SimulatedDevice, BeginsItsTraceAtTheConfiguredTime) {
  const reckon::test::ScratchFolder folder;
  std::ofstream(folder.file("trace.csv")) << "t_s,px_m,py_m,pz_m\n0,0,0,0\n1,0,0,0.01\n"
                                             "2,0,0,0.02\n3,0,0,0.03\n4,0,0,0.04\n";
  std::ofstream(folder.file("scene.toml"))
      << "[[operator]]\ntrace = \"trace.csv\"\nspeed = 2\nbegin = \"1 s\"\nstart = \"0.5 s\"\n";
  const peer::SceneFile file = peer::load_scene_file(folder.file("scene.toml"));
  const auto device = make_simulated_hand(file, 0);
  EXPECT_NEAR(device->position().z(), 0.01, 1e-12) << "it stands where it begins";
  for (auto now = 0ms; now <= 500ms; now += 1ms) static_cast<void>(device->read(now));
  EXPECT_NEAR(device->position().z(), 0.01, 1e-9) << "and rests until it starts";
  for (auto now = 501ms; now <= 1000ms; now += 1ms) static_cast<void>(device->read(now));
  // A second of the recording later; the grip lags.
  EXPECT_NEAR(device->position().z(), 0.02, 0.001);
}

TEST(SimulatedDevice, ReachesItsTraceFromAsideInTime) {
  const reckon::test::ScratchFolder folder;
  std::ofstream(folder.file("trace.csv")) << "t_s,px_m,py_m,pz_m\n0,0.1,0,0\n9,0.1,0,0\n";
  std::ofstream(folder.file("scene.toml"))
      << "[[operator]]\ntrace = \"trace.csv\"\napproach = \"0 60 0 mm\"\nstart = \"1 s\"\n";
  const peer::SceneFile file = peer::load_scene_file(folder.file("scene.toml"));
  const auto device = make_simulated_hand(file, 0);
  EXPECT_LE((device->position() - Vector3d(0.1, 0.06, 0)).norm(), 1e-12);
  double fastest = 0;
  for (auto now = 0ms; now <= 2s; now += 1ms)
    fastest = std::max(fastest, -device->read(now).velocity.y());
  EXPECT_NEAR(fastest, 1.875 * 0.06, 0.002) << "minimum jerk: 15/8 of the mean speed";
  EXPECT_LE((device->position() - Vector3d(0.1, 0, 0)).norm(), 1e-5);
}

// How long a force that is written once stays at the handle.
std::chrono::nanoseconds held(haptics::SimulatedDevice& device) {
  static_cast<void>(device.read(0ms));
  device.write(Vector3d(1, 0, 0), 0ms);
  auto now = 0us;
  while (!device.read(now).watchdog) now += 10us;
  return now;
}

TEST(SimulatedDevice, ReleasesAForceHalfAPeriodLate) {
  const peer::SceneFile file = scene(kSweep);
  peer::DeviceConfig config;
  EXPECT_EQ(held(*make_simulated_device(file, config)), 1510us);
  config.period = 250us;
  EXPECT_EQ(held(*make_simulated_device(file, config)), 380us);
  config.period = 10ms;
  EXPECT_EQ(held(*make_simulated_device(file, config)), 10010us) << "the watchdog";
}

// In and out of a wall and of another's hand, one step in twenty 1 to 9.8 ms late.
TEST(SimulatedDevice, MakesAlmostNoEnergyWithLateSteps) {
  const peer::SceneFile file = scene(
      "[[operator]]\nsweep = { from = \"0 0 20 mm\", to = \"0 0 -25 mm\", period = \"0.5 s\" }\n"
      "stiffness = 1000\n[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\n"
      "surface = { stiffness = 700 }\n[hand]\nradius = \"10 mm\"\n");
  double least = 0, meter = 0;
  std::uint64_t late = 0, let_go = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const auto device = make_simulated_hand(file, 0);
    haptics::ServoLoop servo(*device, haptics::EffectPlan(file.scene), {});
    haptics::ContactSet set;
    haptics::RemoteHand& ball = set.hands[set.count++];
    ball.id = {1, 2, 3};
    ball.state.position.z() = -0.025;
    ball.model.kind = pdu::ForceModelKind::sphere;
    ball.model.k1 = 500;
    ball.model.radius = 0.02;
    ball.valid_until = 1000s;
    ball.version = 1;
    servo.contacts().write(set);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(0, 1);
    for (std::chrono::nanoseconds now{0}; now < 2s; now += 1ms) {
      if (u(random) < 0.05)
        now += std::chrono::nanoseconds(static_cast<std::int64_t>(1e6 * (1 + 8.8 * u(random))));
      servo.step(now);
      servo.snapshots().update();
      const double truth = device->port_work() + device->damping_loss();
      least = std::min(least, truth + servo.snapshots().read().loan);
      meter = std::max(meter, servo.snapshots().read().port_energy - truth);
    }
    late += servo.snapshots().read().tally.late;
    let_go += servo.snapshots().read().tally.force_drops;
  }
  std::printf("%llu late steps, %llu let go: least %.3f mJ at the port, meter too high by %.2g J\n",
              static_cast<unsigned long long>(late), static_cast<unsigned long long>(let_go),
              1e3 * least, meter);
  EXPECT_GT(let_go, 1000u);
  EXPECT_GE(late, let_go);
  EXPECT_GE(least, -1e-9) << "beside what was lent to a wall that lost its force";
  EXPECT_LE(meter, 1e-9);
}

TEST(CheckFiles, OpensTheTraceOfEveryDevice) {
  peer::SceneFile file = scene(std::string(kSweep) +
                               "[[operator]]\npassive = true\n[[device]]\n"
                               "peer = 2\noperator = 2\n");
  EXPECT_NO_THROW(check_files(file, 1));
  file.operators[1].kind = peer::OperatorKind::trace;
  file.operators[1].trace = "/no/such/trace.csv";
  EXPECT_THROW(check_files(file, 1), std::runtime_error);
}

}  // namespace
}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices made from scenes: who holds them, where they stand, what they can do.
#include "reckon/tools/exercise/simulated_hand.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "reckon/peer/scene/belongings.hpp"

namespace reckon::tools {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

constexpr const char* kSweep =
    "[[operator]]\nsweep = { from = \"-60 0 0 mm\", to = \"60 20 0 mm\", period = \"2 s\" }\n";

peer::SceneFile scene(const std::string& text) { return peer::parse_scene_file(text, "x.toml"); }

/// Where the free handle is at each 10 ms, in S.
std::vector<Vector3d> way(const peer::SceneFile& file, const peer::DeviceConfig& config) {
  const auto device = make_simulated_device(file, config);
  std::vector<Vector3d> points;
  for (auto now = 0ms; now < 2s; now += 10ms) {
    const Vector3d p_D = device->read(now).position;
    points.push_back(config.position + config.orientation * p_D);
  }
  return points;
}

TEST(SimulatedDevice, MovesItsHandTheSameWayInTheSceneHoweverItStands) {
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

TEST(SimulatedDevice, TellsTheServoTheLimitsOfItsTable) {
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

TEST(SimulatedDevice, OfASceneWithoutAnyIsTheHandOfThatNumber) {
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

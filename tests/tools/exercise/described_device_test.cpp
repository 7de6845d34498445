// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices with descriptors, and hands that do not follow their handles one to one.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/exercise/device_measuring.hpp"
#include "reckon/tools/exercise/exercise.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using Eigen::Vector3d;
using test::run_reckon;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using namespace std::chrono_literals;

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry :
       std::filesystem::directory_iterator(reckon::test::source_dir() + "/devices"))
    names.push_back(entry.path().stem().string());
  return names;
}

// Positions of the free hand at each 10 ms, in S.
std::vector<Vector3d> way_of(const std::string& device) {
  const peer::SceneFile file = peer::parse_scene_file(
      "[[operator]]\nsweep = { from = \"-60 0 10 mm\", to = \"60 20 0 mm\", period = \"2 s\" }\n"
      "[[device]]\nposition = \"20 -10 5 cm\"\nheading = \"50 deg\"\nroll = \"-70 deg\"\n" +
          device,
      "x.toml");
  const SimulatedHands hands = make_simulated_hands(file, 1);
  const peer::PeerDevice& wired = hands.wired.at(0);
  std::vector<Vector3d> points;
  for (auto now = 0ms; now < 2s; now += 10ms)
    points.push_back(wired.origin + wired.orientation * wired.device->read(now).position);
  return points;
}

TEST(MappedHand, MovesAlikeInTheSceneForAnyMapping) {
  const std::vector<Vector3d> plain = way_of("");
  EXPECT_GT((plain[100] - plain[0]).norm(), 0.1);
  for (const char* mapping : {"scale = 3\n", "left_handed = true\n",
                              "scale = 0.25\nleft_handed = true\nclutch_button = 1\n"}) {
    const std::vector<Vector3d> mapped = way_of(mapping);
    for (std::size_t i = 0; i < plain.size(); ++i)
      EXPECT_LE((mapped[i] - plain[i]).norm(), 1e-12) << mapping << i;
  }
}

peer::SceneFile wall_scene(const std::string& device) {
  return peer::parse_scene_file(
      "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nsurface = { stiffness = 20000 }\n"
      "[[operator]]\nsweep = { from = \"0 0 5 mm\", to = \"0 0 -10 mm\", period = \"1 s\" }\n"
      "[[device]]\n" +
          device,
      "x.toml");
}

// Each presses into a wall that it softens to its own limit.
TEST(DescribedHand, ShippedDescriptorsAreStableAtAWall) {
  ASSERT_GE(shipped().size(), 5U);
  for (const std::string& name : shipped()) {
    for (const char* more : {"", "scale = 3\nleft_handed = true\n"}) {
      SCOPED_TRACE(name + more);
      const peer::SceneFile scene = wall_scene("descriptor = \"" + name + "\"\n" + more);
      ExerciseOptions options;
      options.peers = 1;
      options.simulated_time = true;
      Exercise exercise(scene, options);
      exercise.run(4s);
      const DemoMeasurement& measured = exercise.measurement();
      EXPECT_GT(measured.peak_force(), 0.01);
      EXPECT_LE(measured.peak_force() * scene.devices[0].scale, scene.devices[0].max_force + 1e-9);
      EXPECT_EQ(measured.trips(), 0U);
      // Energy hidden by encoder steps is not made; see encoder_allowance.
      const haptics::ServoSnapshot& servo = exercise.view(0).servo();
      EXPECT_GE(servo.port_energy_min, -1e-9 - servo.late_cost);
    }
  }
}

TEST(DescribedHand, SimulatedOneHasItsDescriptorsMassAndFriction) {
  const reckon::test::ScratchFolder folder;
  std::ofstream(folder.file("heavy.toml"))
      << "name = \"heavy\"\nmax_force = 5\ndamping = 0\nresolution = 0\ndelay = 0\nmass = 0.5\n"
         "friction = \"1 N\"\n";
  const peer::SceneFile scene = peer::parse_scene_file(
      "[[operator]]\npassive = true\nstiffness = 0\ndamping = 0\n"
      "[[device]]\ndescriptor = \"heavy\"\n",
      "x.toml", folder.file(""));
  const auto device = make_simulated_device(scene, scene.devices[0]);
  (void)device->read(0ms);
  device->write({2, 0, 0}, 0ms);
  (void)device->read(1ms);
  // (2 - 1) N on 0.5 kg for 1 ms.
  EXPECT_NEAR(device->velocity().x(), 0.002, 1e-12);
}

TEST(DescribedHand, IsExplainedWithItsDescriptorAndItsMapping) {
  const reckon::test::ScratchFolder folder;
  std::ofstream(folder.file("x.toml"))
      << "[[operator]]\npassive = true\n[[device]]\ndescriptor = \"touch\"\nscale = 2\n"
         "left_handed = true\nclutch_button = 1\n";
  const std::string out = run_reckon({"scene", "explain", folder.file("x.toml")}).out;
  EXPECT_THAT(out, HasSubstr("3D Systems Touch (touch.toml): 45 g, dry friction 260 mN, work space "
                             "160 x 70 x 120 mm"));
  EXPECT_THAT(
      out,
      AllOf(HasSubstr("2 times as far as the handle, with at most 1.65 N in the scene"),
            HasSubstr("left and right are swapped"), HasSubstr("it stays while button 1 is down")));
}

TEST(DevicesVerb, PrintsTheLimitsOfADescriptor) {
  const auto one = run_reckon({"devices", "describe", "touch"});
  EXPECT_EQ(one.status, 0) << one.err;
  // 0.95 x 2 b / (T (1 + 2 d)) of 0.2 N s/m and two samples: 76 N/m, 3/4 of it for walls, half of
  // it for hands.
  EXPECT_THAT(one.out, AllOf(HasSubstr("3D Systems Touch"), HasSubstr("3.3 N"),
                             HasSubstr("walls up to 57 N/m, hands up to 38 N/m")));
  const auto all = run_reckon({"devices", "describe", "--json"});
  std::size_t count = 0;
  for (const std::string& line : all.lines()) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_GT(json["max_force_n"].get<double>(), 0.0);
    EXPECT_GT(json["walls_n_m"].get<double>(), 0.0);
    ++count;
  }
  EXPECT_EQ(count, shipped().size());
}

TEST(DevicesVerb, RefusesUnknownDevicesAndActions) {
  const auto none = run_reckon({"devices", "describe", "no_such_thing"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("searched"));
  const auto action = run_reckon({"devices", "show"});
  EXPECT_EQ(action.status, 2);
  EXPECT_THAT(action.err, HasSubstr("is not one of describe, keys, measure"));
  EXPECT_EQ(run_reckon({"devices", "describe", "--install-rule"}).status, 2);
}

// The measurement of a simulated device gives its descriptor.
TEST(DevicesVerb, MeasuresASimulatedDeviceAndPrintsItsDescriptor) {
  const auto result = run_reckon({"devices", "measure", "mine", "--simulate", "polhem"});
  ASSERT_EQ(result.status, 0) << result.err;
  const peer::DeviceDescriptor found = peer::parse_device_descriptor(result.out, "mine.toml");
  const peer::DeviceDescriptor truth =
      peer::load_device_descriptor(reckon::test::source_dir() + "/devices/polhem.toml");
  EXPECT_EQ(found.name, "mine");
  EXPECT_EQ(found.usb, truth.usb);
  EXPECT_NEAR(found.damping, truth.damping, 0.1 * truth.damping);
  EXPECT_NEAR(found.friction, truth.friction, 0.1 * truth.friction);
  EXPECT_EQ(found.delay, truth.delay);
  EXPECT_NEAR(found.resolution, truth.resolution, 0.01 * truth.resolution);
  EXPECT_NEAR(found.mass, truth.mass, 0.1 * truth.mass);
  EXPECT_EQ(found.max_force, truth.max_force);
  EXPECT_TRUE(found.work_space.to.isApprox(truth.work_space.to, 1e-9));
}

TEST(DevicesVerb, NamesTheReasonOfAFailedMeasurement) {
  const reckon::test::ScratchFolder folder;
  std::ofstream(folder.file("late.toml"))
      << "name = \"late\"\nmax_force = 8\ndamping = 1\nresolution = 0.00002\ndelay = 0.08\n";
  const auto late = run_reckon({"devices", "measure", "x", "--simulate", folder.file("late.toml")});
  EXPECT_EQ(late.status, 3);
  EXPECT_THAT(late.err, HasSubstr("late: its forces are more than 50 ms late"));
  EXPECT_EQ(late.out, "");
  const auto six = run_reckon({"devices", "measure", "x", "--simulate", "freedom_6s"});
  EXPECT_THAT(six.err, HasSubstr("only devices of three axes can be measured"));
  EXPECT_THAT(run_reckon({"devices", "measure", "x"}).err, HasSubstr("there is no driver 'x'"));
  EXPECT_EQ(run_reckon({"devices", "measure", "--simulate", "polhem"}).status, 2);
  EXPECT_EQ(run_reckon({"devices", "--simulate", "polhem"}).status, 2);
  for (const auto problem :
       {haptics::MeasurementProblem::readings, haptics::MeasurementProblem::switch_off,
        haptics::MeasurementProblem::restless, haptics::MeasurementProblem::speed,
        haptics::MeasurementProblem::place, haptics::MeasurementProblem::active,
        haptics::MeasurementProblem::stuck, haptics::MeasurementProblem::late,
        haptics::MeasurementProblem::unlike})
    EXPECT_FALSE(sentence_of(problem).empty()) << static_cast<int>(problem);
}

}  // namespace
}  // namespace reckon::tools

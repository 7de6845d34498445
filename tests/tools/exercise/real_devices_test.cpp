// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// --device and --firmware, and the real device that replaces a simulated one.
#include "reckon/tools/exercise/real_devices.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <tuple>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/usb/usb_line.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kTwoHands =
    "[[operator]]\npassive = true\n[[operator]]\npassive = true\nposition = \"0.1 0 0 m\"\n";

template <class Call>
std::string usage_error(Call&& call) {
  try {
    call();
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

TEST(RealDevices, ThePeersFirstDeviceGetsTheChosenDriver) {
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  choose_device({"falcon"}, scene, 2, 2);
  ASSERT_EQ(scene.devices.size(), 2U);
  EXPECT_EQ(peer::driver_name(scene.devices[0]), "simulated");
  EXPECT_EQ(peer::driver_name(scene.devices[1]), "falcon");
  EXPECT_EQ(scene.devices[1].peer, 2U);
  // The simulated device's damping does not apply to this one.
  EXPECT_LT(scene.devices[1].damping, 0.5);
  EXPECT_EQ(scene.devices[1].delay_samples, 6);
}

TEST(RealDevices, KeepsTheFilesValuesOfAFalcon) {
  peer::SceneFile scene = peer::parse_scene_file(
      std::string("[[device]]\ndriver = \"falcon\"\ndamping = \"2 N s/m\"\n") + kTwoHands,
      "x.toml");
  choose_device({"falcon"}, scene, 1, 2);
  EXPECT_NEAR(scene.devices.at(0).damping, 1.8, 1e-12);
  EXPECT_EQ(scene.devices[0].joint_damping, 0.0) << "it is that of every pose";
}

// An assumed damping is of the joints, which give less far out.
TEST(RealDevices, AnAssumedDampingIsThatOfTheMiddle) {
  for (const auto& [name, damping, square] :
       {std::tuple("falcon", 0.3, 0.0049), std::tuple("polhem", 0.2, 0.0365)}) {
    peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
    choose_device({name}, scene, 1, 2);
    EXPECT_NEAR(scene.devices.at(0).joint_damping, damping * square, 0.01 * damping * square);
    EXPECT_LE(scene.devices[0].damping, 0.9 * damping * 1.0001);
    EXPECT_GT(scene.devices[0].damping, 0.8 * damping);
  }
}

TEST(RealDevices, DescriptorChoosesTheDriverByItsUsbNumbers) {
  const test::ScratchFolder folder;
  const std::string mine = folder.file("mine.toml");
  const auto write = [&](const std::string& ids) {
    std::ofstream(mine) << "name = \"mine\"\n"
                        << ids
                        << "max_force = \"4 N\"\ndamping = \"3 N s/m\"\n"
                           "resolution = \"0.09 mm\"\ndelay = \"3.5 ms\"\n";
  };
  write("usb = [\"0403:cb48\"]\n");
  EXPECT_EQ(usage_error([&] { check_device_choice({mine}); }), "");
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  choose_device({mine}, scene, 1, 2);
  EXPECT_EQ(peer::driver_name(scene.devices.at(0)), "falcon");
  EXPECT_NEAR(scene.devices[0].damping, 2.7, 0.01) << "in the middle";
  EXPECT_NEAR(scene.devices[0].joint_damping, 3 * 0.07 * 0.07, 2e-4);
  EXPECT_EQ(scene.devices[0].max_force, 4.0);
  EXPECT_EQ(scene.devices[0].delay_samples, 4);
  write("usb = [\"0403:0001\"]\n");
  EXPECT_THAT(usage_error([&] { check_device_choice({mine}); }),
              AllOf(HasSubstr("no driver has the USB IDs"), HasSubstr("0403:cb48")));
  EXPECT_THAT(usage_error([&] { check_device_choice({folder.file("none.toml")}); }),
              AllOf(HasSubstr("--device"), HasSubstr("none.toml")));
}

// With the handle in the centre of a stone its user would feel no surface.
TEST(RealDevices, DevicePositionDefaultsToItsOperatorsStart) {
  const auto place = [](const std::string& device, const std::string& hands) {
    const test::ScratchFolder folder;
    std::ofstream(folder.file("trace.csv")) << "t_s,px_m,py_m,pz_m\n0,0,0,0\n1,0.1,0.2,0.3\n"
                                            << "2,0.1,0.2,0.5\n";
    std::ofstream(folder.file("x.toml")) << device + hands;
    peer::SceneFile scene = peer::load_scene_file(folder.file("x.toml"));
    choose_device({"falcon"}, scene, 1, 1);
    return scene.devices.at(0).position;
  };
  const std::string passive = "[[operator]]\npassive = true\nposition = \"0.1 0 0 m\"\n";
  const std::string sweep =
      "[[operator]]\nsweep = {from = \"0 0 20 mm\", to = \"0 20 0 mm\", period = \"1 s\"}\n";
  const std::string trace =
      "[[operator]]\ntrace = \"trace.csv\"\nbegin = \"1 s\"\nstart = \"3 s\"\n"
      "approach = \"0 -60 0 mm\"\n";
  EXPECT_EQ(place("", passive), Eigen::Vector3d(0.1, 0, 0));
  EXPECT_EQ(place("", sweep), Eigen::Vector3d(0, 0.01, 0.01));
  EXPECT_LT((place("", trace) - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_EQ(place("", ""), Eigen::Vector3d(0, 0, 0)) << "nobody is there to begin";
  EXPECT_EQ(place("[[device]]\nposition = [0.0, 0.0, 0.0]\n", passive), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(place("[[device]]\ndriver = \"falcon\"\n", passive), Eigen::Vector3d(0.1, 0, 0));
  peer::SceneFile simulated = peer::parse_scene_file("[[device]]\n" + passive, "x.toml");
  choose_device({}, simulated, 1, 1);
  EXPECT_EQ(simulated.devices.at(0).position, Eigen::Vector3d(0, 0, 0));
}

TEST(RealDevices, NothingChangesWithoutAChoice) {
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  choose_device({}, scene, 1, 2);
  EXPECT_TRUE(scene.devices.empty());
}

TEST(RealDevices, AWrongNameGetsTheNearest) {
  EXPECT_THAT(usage_error([] { check_device_choice({"falkon"}); }),
              AllOf(HasSubstr("--device"), HasSubstr("did you mean 'falcon'?")));
  EXPECT_THAT(usage_error([] { check_device_choice({"crane"}); }),
              HasSubstr("write falcon, polhem, evdev"));
}

TEST(RealDevices, EachNameIsAccepted) {
  for (const char* name : {"falcon", "polhem", "evdev"})
    EXPECT_EQ(usage_error([&] { check_device_choice({name}); }), "") << name;
}

TEST(RealDevices, DriverFileIsLoadedAndReported) {
  const std::string file = std::string(RECKON_TEST_DRIVERS) + "/dummy_device.so";
  EXPECT_EQ(usage_error([&] { check_device_choice({file}); }), "");
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  choose_device({file}, scene, 2, 2);
  EXPECT_EQ(peer::driver_name(scene.devices.at(1)), "plugin");
  SimulatedHands hands = make_simulated_hands(scene, 2);
  RealDevices real(plugins_of({file}));
  real.plug_in(scene, 2, hands.wired);
  EXPECT_NE(hands.wired.at(0).device, hands.devices.at(0).get());
  EXPECT_EQ(hands.wired.at(0).device->limits().max_force, 10.0);
  EXPECT_THAT(real.take_notices(),
              ::testing::ElementsAre(AllOf(HasSubstr("dummy: assumes 1 N s/m"), HasSubstr(file))));

  scene.devices[1].driver_values["plugin"] = std::string("none.so");
  EXPECT_THROW(RealDevices({"none.so"}).plug_in(scene, 2, hands.wired), std::runtime_error);
  EXPECT_THROW(RealDevices().plug_in(scene, 2, hands.wired), UsageError);
}

TEST(RealDevices, AFirmwareNeedsADeviceThatTakesIt) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("program.bin");
  std::ofstream(file) << std::string(5000, 'x');
  EXPECT_THAT(usage_error([&] { check_device_choice({"falcon", {}, {{"firmware", file}}}); }), "");
  EXPECT_THAT(usage_error([&] {
                check_device_choice({"falcon", {}, {{"firmware", folder.file("none")}}});
              }),
              AllOf(HasSubstr("--firmware"), HasSubstr("none")));
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  EXPECT_THAT(usage_error([&] {
                choose_device({"", {}, {{"firmware", file}}}, scene, 1, 2);
              }),
              HasSubstr("add --device falcon"));
  choose_device({"falcon", {}, {{"firmware", file}}}, scene, 1, 2);
  EXPECT_EQ(peer::driver_value<std::filesystem::path>(scene.devices.at(0), "firmware"), file);
}

TEST(RealDevices, EventDeviceNeedsTheScenesScale) {
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  EXPECT_THAT(usage_error([&] { choose_device({"evdev"}, scene, 1, 2); }),
              AllOf(HasSubstr("--device evdev"), HasSubstr("write 'travel' in its [[device]]")));
  scene = peer::parse_scene_file(
      std::string("[[device]]\ntravel = \"0.2 m\"\nfull_force = \"20 N\"\nfull_stiffness = "
                  "2000\nmax_stiffness = 1500\nevent = \"/no/such/device\"\n") +
          kTwoHands,
      "x.toml");
  choose_device({"evdev"}, scene, 1, 2);
  EXPECT_EQ(peer::driver_name(scene.devices.at(0)), "evdev");
  SimulatedHands hands = make_simulated_hands(scene, 1);
  RealDevices real;
  real.plug_in(scene, 1, hands.wired);
  const haptics::DeviceLimits limits = hands.wired.at(0).device->limits();
  EXPECT_EQ(limits.kind, haptics::DeviceKind::coefficients);
  EXPECT_EQ(limits.axes, 2);
  EXPECT_EQ(limits.max_stiffness, 1500);
  EXPECT_THAT(real.take_notices(),
              ::testing::Contains(HasSubstr("do not move a hand that does not press")));
  for (const char* path : {"/dev/input/event7", "/dev/hidraw0"}) {
    choose_device({path}, scene, 1, 2);
    EXPECT_EQ(peer::driver_name(scene.devices[0]), "evdev");
    EXPECT_EQ(peer::driver_value<std::string>(scene.devices[0], "event"), path);
    EXPECT_EQ(peer::driver_value<std::string>(scene.devices[0], "port"), "")
        << "it is no serial line";
  }
}

TEST(RealDevices, ExplainedEventDeviceMatchesItsServo) {
  const std::string wheel =
      "[[device]]\ndriver = \"evdev\"\ntravel = \"0.2 m\"\nfull_force = \"20 N\"\nfull_stiffness = "
      "2000\nmax_stiffness = 1500\n";
  const test::ScratchFolder folder;
  const auto explained = [&](const std::string& object) {
    const std::string file = folder.file("scene.toml");
    std::ofstream(file) << wheel << "[[object]]\nname = \"thing\"\n" << object << kTwoHands;
    return test::run_reckon({"scene", "explain", file});
  };
  const auto good = explained("plane = [1, 0, 0]\nposition = [-0.02, 0, 0]\n");
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_THAT(good.out,
              HasSubstr("walls, hands and entities up to 1.5 kN/m, rendered by the device"));
  EXPECT_THAT(good.out, HasSubstr("two axes over 200 mm; a change acts 8 ms later"));
  const auto bad = explained("sphere = \"10 mm\"\n");
  EXPECT_NE(bad.status, 0);
  EXPECT_THAT(bad.err, HasSubstr("'thing' is neither a plane nor a box"));
}

TEST(RealDevices, APeerWithoutADeviceCannotHaveOne) {
  peer::SceneFile scene =
      peer::parse_scene_file(std::string("[[device]]\npeer = 2\n") + kTwoHands, "x.toml");
  EXPECT_THAT(usage_error([&] { choose_device({"falcon"}, scene, 1, 2); }),
              HasSubstr("peer 1 has no device"));
}

// A simulated one has exactly the limits of the real one's servo.
TEST(RealDevices, ExplainedFalconMatchesItsServo) {
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  choose_device({"falcon"}, scene, 1, 2);
  const haptics::DeviceLimits simulated = make_simulated_device(scene, scene.devices[0])->limits();
  const haptics::DeviceLimits real =
      haptics::usb_limits(haptics::falcon_facts(), peer::usb_settings_of(scene.devices[0]));
  EXPECT_EQ(simulated.max_force, real.max_force);
  EXPECT_NEAR(simulated.damping, real.damping, 1e-15);
  EXPECT_EQ(simulated.delay_samples, real.delay_samples);
  EXPECT_EQ(simulated.resolution, real.resolution);
  EXPECT_EQ(simulated.max_speed, real.max_speed);
}

TEST(RealDevices, PolhemIsChosenWithItsOwnLimits) {
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  EXPECT_THAT(usage_error([] { check_device_choice({"polhme"}); }),
              HasSubstr("did you mean 'polhem'?"));
  choose_device({"polhem"}, scene, 1, 2);
  EXPECT_EQ(peer::driver_name(scene.devices.at(0)), "polhem");
  EXPECT_EQ(peer::driver_name(scene.devices[1]), "simulated");
  const haptics::DeviceLimits simulated = make_simulated_device(scene, scene.devices[0])->limits();
  const haptics::DeviceLimits real =
      haptics::usb_limits(haptics::polhem_facts(), peer::usb_settings_of(scene.devices[0]));
  EXPECT_EQ(simulated.max_force, 5.0);
  EXPECT_EQ(real.max_force, 5.0);
  EXPECT_NEAR(simulated.damping, 0.9 * 0.2, 0.015);
  EXPECT_EQ(real.damping, simulated.damping);
  EXPECT_EQ(simulated.delay_samples, real.delay_samples);
  EXPECT_EQ(simulated.resolution, real.resolution);
  EXPECT_THAT(usage_error([&] {
                choose_device({"", {}, {{"firmware", __FILE__}}}, scene, 1, 2);
              }),
              HasSubstr("add --device falcon"));
}

TEST(RealDevices, ASerialBoardGoesByItsLine) {
  peer::SceneFile scene = peer::parse_scene_file(kTwoHands, "x.toml");
  choose_device({"/dev/ttyUSB7@115200"}, scene, 2, 2);
  ASSERT_EQ(scene.devices.size(), 2U);
  EXPECT_EQ(peer::driver_name(scene.devices[0]), "simulated");
  EXPECT_EQ(peer::driver_name(scene.devices[1]), "serial");
  EXPECT_EQ(peer::driver_value<std::string>(scene.devices[1], "port"), "/dev/ttyUSB7");
  EXPECT_EQ(peer::driver_value<std::uint32_t>(scene.devices[1], "baud"), 115'200U);
  EXPECT_EQ(scene.devices[1].max_force, 1.0) << "what was said is of a simulated one";
  choose_device({"/dev/ttyACM0"}, scene, 2, 2);
  EXPECT_EQ(peer::driver_value<std::uint32_t>(scene.devices[1], "baud"), 1'000'000U);

  const auto refused = [](const std::string& device) {
    return usage_error([&] { check_device_choice({device}); });
  };
  EXPECT_EQ(refused("/dev/ttyACM0"), "");
  EXPECT_EQ(refused("/dev/serial/by-id/usb-Board-if00"), "");
  EXPECT_THAT(refused("serial"), HasSubstr("write the port of a serial board (/dev/ttyACM0"));
  for (const char* baud : {"", "fast", "12e6", "1199", "12000001", "99999999999"})
    EXPECT_THAT(refused(std::string("/dev/ttyACM0@") + baud), HasSubstr("is not a baud rate"))
        << baud;
}

TEST(RealDevices, KeepsTheFilesValuesOfABoard) {
  peer::SceneFile scene = peer::parse_scene_file(
      std::string("[[device]]\ndriver = \"serial\"\nport = \"/dev/ttyACM0\"\n"
                  "damping = \"2 N s/m\"\nmax_force = \"3 N\"\n") +
          kTwoHands,
      "x.toml");
  choose_device({"/dev/ttyACM1"}, scene, 1, 2);
  EXPECT_EQ(peer::driver_value<std::string>(scene.devices.at(0), "port"), "/dev/ttyACM1");
  EXPECT_EQ(scene.devices[0].max_force, 3.0);
  EXPECT_NEAR(scene.devices[0].damping, 1.8, 1e-12);
}

TEST(RealDevices, ALineHasOneBoard) {
  peer::SceneFile scene = peer::parse_scene_file(
      std::string("[[device]]\ndriver = \"serial\"\nport = \"/dev/none\"\n"
                  "[[device]]\ndriver = \"serial\"\nport = \"/dev/none\"\n") +
          kTwoHands,
      "x.toml");
  SimulatedHands hands = make_simulated_hands(scene, 1);
  RealDevices real;
  try {
    real.plug_in(scene, 1, hands.wired);
    FAIL() << "two on a line";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("two devices use /dev/none"));
  }
}

TEST(RealDevices, DemoContinuesWithoutTheBoardAndReportsOnce) {
  const test::ProgramResult result =
      test::run_reckon({"demo", "--device", "/dev/none", "--for", "700ms", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("/dev/none: there is no /dev/none: plug it in"));
  EXPECT_THAT(result.err, HasSubstr("/dev/none: assumes 0.09 N s/m of damping"));
}

TEST(RealDevices, DemoContinuesWithoutTheDeviceAndReportsOnce) {
  try {
    const haptics::UsbContext usb;
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  const test::ProgramResult result =
      test::run_reckon({"demo", "--device", "falcon", "--for", "700ms", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("Falcon: "));
  const test::ProgramResult other =
      test::run_reckon({"demo", "--device", "polhem", "--for", "700ms", "--json"});
  EXPECT_EQ(other.status, 0) << other.err;
  EXPECT_THAT(other.err, HasSubstr("Polhem: none is attached"));
}

}  // namespace
}  // namespace reckon::tools

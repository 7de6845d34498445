// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/device_descriptor.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

namespace fs = std::filesystem;

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using namespace std::chrono_literals;

constexpr const char* kThree =
    "name = \"Pen\"\nmax_force = \"3 N\"\ndamping = 0.4\nresolution = \"50 um\"\ndelay = \"2 "
    "ms\"\n";
constexpr const char* kSix =
    "name = \"Six\"\naxes = 6\nmax_force = \"3 N\"\ndamping = 0.4\nresolution = 0\ndelay = 0\n"
    "max_torque = \"0.2 N m\"\nturn_damping = 0.001\nturn_resolution = 0\n";

std::string refusal_of(const std::string& text) {
  try {
    (void)parse_device_descriptor(text, "mine.toml");
  } catch (const SceneFileError& error) {
    return error.what();
  }
  return "taken";
}

TEST(DeviceDescriptor, GivesEveryValueInSi) {
  const DeviceDescriptor device = parse_device_descriptor(R"(
name = "Delta"
usb = ["1451:0402", "ABCD:0001"]
kind = "impedance"
axes = 6
max_force = "20 N"
max_torque = "200 mN m"
damping = "2 N s/m"
turn_damping = "0.004 N m s/rad"
resolution = "30 um"
turn_resolution = "0.02 deg"
delay = "250 us"
max_stiffness = "14.5 N/mm"
max_speed = "3 m/s"
mass = "120 g"
inertia = "800 g cm2"
friction = "100 mN"
work_space = { from = "-18 -18 -13 cm", to = [0.18, 0.18, 0.13] }
)",
                                                          "x.toml");
  EXPECT_EQ(device.name, "Delta");
  EXPECT_THAT(device.usb, testing::ElementsAre(UsbId{0x1451, 0x0402}, UsbId{0xABCD, 1}));
  EXPECT_EQ(device.axes, 6);
  EXPECT_EQ(device.max_force, 20);
  EXPECT_NEAR(device.max_torque, 0.2, 1e-15);
  EXPECT_EQ(device.damping, 2);
  EXPECT_EQ(device.turn_damping, 0.004);
  EXPECT_NEAR(device.resolution, 3e-5, 1e-18);
  EXPECT_NEAR(device.turn_resolution, 0.02 * M_PI / 180, 1e-15);
  EXPECT_EQ(device.delay, 250us);
  EXPECT_EQ(device.max_stiffness, 14500);
  EXPECT_EQ(device.max_speed, 3);
  EXPECT_EQ(device.mass, 0.12);
  EXPECT_NEAR(device.inertia, 8e-5, 1e-18);
  EXPECT_EQ(device.friction, 0.1);
  EXPECT_LT((device.work_space.from - Vector3d(-0.18, -0.18, -0.13)).norm(), 1e-15);
  EXPECT_EQ(device.work_space.to, Vector3d(0.18, 0.18, 0.13));
}

TEST(DeviceDescriptor, RefusesBadKeysWithPlaceAndRemedy) {
  const struct {
    std::string text;
    const char *place, *says;
  } rows[] = {
      {std::string(kThree) + "axis = 3\n", "mine.toml:6:1:", "did you mean 'axes'?"},
      {std::string(kThree) + "axes = 4\n", "mine.toml:6:8:", "4 axes are not supported"},
      {std::string(kThree) + "axes = 1\n", "mine.toml:6:8:", "1 axes are not supported"},
      {std::string(kThree) + "axes = 9\n", "mine.toml:6:8:", "it must be 1 to 8"},
      {std::string(kThree) + "kind = \"admittance\"\n", "mine.toml:6:8:", "impedance devices only"},
      {std::string(kThree) + "kind = \"impedence\"\n",
       "mine.toml:6:8:", "did you mean \"impedance\"?"},
      {std::string(kThree) + "usb = [\"403:cb48\"]\n", "mine.toml:6:8:", "with four digits"},
      {std::string(kThree) + "usb = [\"0403\"]\n", "mine.toml:6:8:", "with four digits"},
      {std::string(kThree) + "usb = [\"0403:cb4g\"]\n", "mine.toml:6:8:", "with four digits"},
      {std::string(kThree) + "inertia = 0.001\n", "mine.toml:6:11:", "needs axes = 6"},
      {std::string(kThree) + "mass = \"100 N\"\n", "mine.toml:6:8:", "kg, g"},
      {std::string(kThree) + "mass = 0\n", "mine.toml:6:8:", "it must be 1 g to 100 kg"},
      {std::string(kThree) + "friction = -1\n", "mine.toml:6:12:", "it must be"},
      {std::string(kThree) + "work_space = { from = \"1 0 0 mm\", to = \"0 1 1 mm\" }\n",
       "mine.toml:6:14:", "greater than 'from'"},
      {"name = 3\n", "mine.toml:1:8:", "it needs text"},
      {"name = \"\"\nmax_force = 1\ndamping = 1\nresolution = 0\ndelay = 0\n",
       "mine.toml:1:8:", "is empty"},
      {"name = \"x\n", "mine.toml:1:", ""},
  };
  for (const auto& row : rows)
    EXPECT_THAT(refusal_of(row.text), AllOf(HasSubstr(row.place), HasSubstr(row.says))) << row.text;
}

TEST(DeviceDescriptor, RequiresKeysWithoutSafeDefault) {
  EXPECT_EQ(refusal_of(kThree), "taken");
  EXPECT_EQ(refusal_of(kSix), "taken");
  for (const char* text : {kThree, kSix}) {
    const std::string whole = text;
    for (const std::string key : {"name", "max_force", "damping", "resolution", "delay",
                                  "max_torque", "turn_damping", "turn_resolution"}) {
      const std::size_t begin = whole.find(key + " =");
      if (begin == std::string::npos) continue;
      std::string without = whole;
      without.erase(begin, whole.find('\n', begin) - begin + 1);
      EXPECT_THAT(refusal_of(without), HasSubstr("'" + key + "'")) << without;
    }
  }
}

TEST(DeviceDescriptor, RefusalOfAMissingOneNamesSearchedPlaces) {
  const reckon::test::ScratchFolder folder;
  try {
    (void)find_device_descriptor("nothing_like_it", folder.file(""));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(folder.file("nothing_like_it.toml")),
                                    HasSubstr("share/reckon/devices/nothing_like_it.toml")));
  }
  try {
    (void)find_device_descriptor("devices/mine.toml", folder.file(""));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::Not(HasSubstr("share/reckon")))
        << "a name with a folder is meant as it is";
  }
}

TEST(DeviceDescriptor, DescriptorsOfReckonAreFoundByName) {
  std::size_t found = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(reckon::test::source_dir()) / "devices")) {
    const std::string name = entry.path().stem().string();
    const fs::path file = find_device_descriptor(name, "/nowhere");
    EXPECT_EQ(file.filename(), entry.path().filename());
    EXPECT_FALSE(load_device_descriptor(entry.path()).name.empty()) << name;
    ++found;
  }
  EXPECT_GE(found, 5U);
}

// A line of a file is a key; its comment states the source of the value.
TEST(DeviceDescriptor, DescriptorsOfReckonStateTheirSources) {
  for (const auto& entry :
       fs::directory_iterator(fs::path(reckon::test::source_dir()) / "devices")) {
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const bool is_fact = !line.empty() && line.front() != '#' && !line.starts_with("name") &&
                           !line.starts_with("kind") && !line.starts_with("axes");
      EXPECT_TRUE(!is_fact || line.find(" # ") != std::string::npos)
          << entry.path() << ": " << line;
    }
  }
}

class DescribedDeviceSection : public testing::Test {
 protected:
  DeviceConfig device_of(const std::string& lines) {
    return parse_scene_file("[[device]]\n" + lines + "[[operator]]\npassive = true\n", "x.toml",
                            folder_.file(""))
        .devices.at(0);
  }
  std::string refusal(const std::string& lines) {
    try {
      (void)device_of(lines);
    } catch (const SceneFileError& error) {
      return error.what();
    }
    return "taken";
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_.file(name)) << text;
  }
  reckon::test::ScratchFolder folder_;
};

TEST_F(DescribedDeviceSection, TakesTheValuesOfItsDescriptor) {
  write("pen.toml", std::string(kThree) +
                        "mass = \"45 g\"\nfriction = \"0.26 N\"\nmax_stiffness = 400\n"
                        "work_space = { from = \"-80 -60 -35 mm\", to = \"80 60 35 mm\" }\n");
  for (const char* name : {"pen", "pen.toml"}) {
    const DeviceConfig device = device_of("descriptor = \"" + std::string(name) + "\"\n");
    EXPECT_EQ(device.descriptor, folder_.file("pen.toml"));
    EXPECT_EQ(device.axes, 3);
    EXPECT_EQ(device.max_force, 3);
    EXPECT_EQ(device.damping, 0.4);
    EXPECT_NEAR(device.resolution, 5e-5, 1e-18);
    EXPECT_EQ(device.delay_samples, 2);
    EXPECT_EQ(device.max_stiffness, 400);
    EXPECT_EQ(device.described.mass, 0.045);
    EXPECT_EQ(device.described.friction, 0.26);
    EXPECT_EQ(device.described.work_space.max(), Vector3d(0.08, 0.06, 0.035));
  }
  EXPECT_EQ(device_of("descriptor = \"pen\"\nrate = \"4 kHz\"\n").delay_samples, 8);
}

TEST_F(DescribedDeviceSection, ItsOwnKeysGoBeforeTheDescriptor) {
  write("pen.toml", kThree);
  const DeviceConfig device =
      device_of("descriptor = \"pen\"\ndamping = \"0.9 N s/m\"\ndelay = \"1 ms\"\n");
  EXPECT_EQ(device.damping, 0.9);
  EXPECT_EQ(device.delay_samples, 1);
  EXPECT_EQ(device.max_force, 3);
  EXPECT_THAT(refusal("descriptor = \"pen\"\naxes = 6\n"), HasSubstr("remove 'axes'"));
}

TEST_F(DescribedDeviceSection, SixAxisDeviceNeedsOnlyItsDescriptor) {
  write("six.toml", std::string(kSix) + "inertia = 0.0002\n");
  const DeviceConfig device = device_of("descriptor = \"six\"\nprobe = [{position = [0, 0, 0]}]\n");
  EXPECT_EQ(device.axes, 6);
  EXPECT_EQ(device.max_torque, 0.2);
  EXPECT_EQ(device.described.inertia, 0.0002);
  write("pen.toml", kThree);
  EXPECT_THAT(refusal("descriptor = \"pen\"\nmax_torque = 1\n"), HasSubstr("needs axes = 6"));
}

TEST_F(DescribedDeviceSection, BadDescriptorIsReportedWithBothPlaces) {
  write("bad.toml", std::string(kThree) + "axes = 4\n");
  EXPECT_THAT(refusal("descriptor = \"bad\"\n"),
              AllOf(HasSubstr("x.toml:2:14: 'descriptor': "), HasSubstr("bad.toml:6:8: ")));
  EXPECT_THAT(refusal("descriptor = \"none\"\n"),
              AllOf(HasSubstr("x.toml:2:14: "), HasSubstr("searched")));
  EXPECT_THAT(refusal("descriptor = 3\n"), HasSubstr("it needs text"));
}

TEST_F(DescribedDeviceSection, FalconTakesDampingAndDelayOfItsDescriptor) {
  write("mine.toml",
        "name = \"my Falcon\"\nmax_force = \"8 N\"\ndamping = 1\nresolution = 0.0001\n"
        "delay = \"3 ms\"\n");
  const DeviceConfig described = device_of("driver = \"falcon\"\ndescriptor = \"mine\"\n");
  const DeviceConfig said = device_of("driver = \"falcon\"\ndamping = 1\ndelay = \"3 ms\"\n");
  // Damping at the centre, and damping of the joints where the table states none.
  EXPECT_NEAR(described.damping, said.damping, 1e-3);
  EXPECT_NEAR(described.joint_damping, haptics::falcon_facts().joints_per_damping, 1e-12);
  EXPECT_EQ(said.joint_damping, 0.0);
  EXPECT_EQ(described.delay_samples, said.delay_samples);
}

TEST_F(DescribedDeviceSection, ReadsHowTheHandleMovesTheHand) {
  const DeviceConfig device =
      device_of("scale = 2.5\nleft_handed = true\nclutch_button = 3\nstop_button = 0\n");
  EXPECT_EQ(device.scale, 2.5);
  EXPECT_TRUE(device.left_handed);
  EXPECT_EQ(device.clutch_button, 3);
  EXPECT_EQ(device.stop_button, 0);
  EXPECT_EQ(device_of("").stop_button, -1);
  EXPECT_THAT(refusal("clutch_button = 3\nstop_button = 3\n"), HasSubstr("choose another"));
  EXPECT_THAT(refusal("clutch_button = 3\ngrab_button = 3\n"), HasSubstr("choose another"));
  EXPECT_THAT(refusal("stop_button = 32\n"), HasSubstr("it must be 0 to 31"));
  EXPECT_THAT(refusal("scale = 0\n"), HasSubstr("it must be 0.01 to 100"));
  EXPECT_THAT(refusal("kind = \"pointer\"\nscale = 2\n"),
              HasSubstr("'scale' does not apply to a pointer"));
}

// The page contains the generated list.
TEST(DeviceDescriptor, KeysEqualTheDocumentedOnes) {
  std::ifstream file(fs::path(reckon::test::source_dir()) / "docs" / "devices.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr(device_descriptor_markdown()));
}

}  // namespace
}  // namespace reckon::peer

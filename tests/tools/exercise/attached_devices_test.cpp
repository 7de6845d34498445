// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The report about devices on USB, own and others.
#include "reckon/tools/exercise/attached_devices.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/peer/drivers/evdev.hpp"
#include "reckon/peer/drivers/serial_lines.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using haptics::UsbDeviceSeen;
using peer::judge_events;
using test::run_reckon;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

UsbDeviceSeen hub() {
  UsbDeviceSeen hub;
  hub.vendor = 0x1d6b;
  hub.product = 2;
  return hub;
}

UsbDeviceSeen falcon(bool open) {
  UsbDeviceSeen seen;
  seen.vendor = haptics::falcon_facts().vendor;
  seen.product = haptics::falcon_facts().product;
  seen.bus = 1;
  seen.address = 4;
  seen.is_open_to_us = open;
  return seen;
}

TEST(AttachedDevices, ShowHowToUseAFalcon) {
  const UsbLook look = judge_usb({hub(), falcon(true)}, {}, false);
  EXPECT_THAT(look.problem, IsEmpty());
  EXPECT_EQ(look.others, 1U);
  ASSERT_EQ(look.devices.size(), 1U);
  EXPECT_EQ(look.devices[0].driver, "falcon");
  EXPECT_EQ(look.devices[0].name, "Novint Falcon, /dev/bus/usb/001/004");
  EXPECT_THAT(look.devices[0].use, HasSubstr("--device falcon"));
  EXPECT_THAT(look.devices[0].problem, IsEmpty());
}

UsbDeviceSeen polhem(bool open) {
  UsbDeviceSeen seen;
  seen.vendor = 0x1234;
  seen.product = 6;
  seen.bus = 2;
  seen.address = 17;
  seen.is_open_to_us = open;
  return seen;
}

TEST(AttachedDevices, ShowHowToUseAPolhem) {
  const UsbLook ready = judge_usb({polhem(true)}, {}, false);
  ASSERT_EQ(ready.devices.size(), 1U);
  EXPECT_EQ(ready.devices[0].driver, "polhem");
  EXPECT_EQ(ready.devices[0].name, "Polhem, /dev/bus/usb/002/017");
  EXPECT_THAT(ready.devices[0].use, HasSubstr("--device polhem"));
  EXPECT_THAT(ready.devices[0].problem, IsEmpty());
  // Beside a Falcon, each has its own report.
  const std::array unhomed{UsbProblem{"polhem", "Polhem: not homed: hold it straight ahead"}};
  const UsbLook both = judge_usb({falcon(true), polhem(true)}, unhomed, false);
  ASSERT_EQ(both.devices.size(), 2U);
  EXPECT_THAT(both.devices[0].problem, IsEmpty());
  EXPECT_THAT(both.devices[1].problem, HasSubstr("not homed"));
  UsbDeviceSeen denied = polhem(false);
  denied.is_denied = true;
  EXPECT_THAT(judge_usb({denied}, {}, false).devices.at(0).remedy, HasSubstr("--install-rule"));
  EXPECT_THAT(judge_usb({denied}, {}, true).devices.at(0).remedy,
              HasSubstr("over ssh, only the group plugdev may open it"));
}

haptics::EventDeviceSeen wheel() {
  haptics::EventDeviceSeen seen;
  seen.path = "/dev/input/event7";
  seen.facts.name = "OpenFFBoard";
  seen.facts.has_springs = seen.facts.has_constant_forces = true;
  seen.facts.most_effects = 16;
  seen.facts.axes[0] = haptics::EventAxis{-32768, 32767};
  return seen;
}

TEST(AttachedDevices, ShowHowToUseAnEventDevice) {
  const auto said = [](const haptics::EventDeviceSeen& seen) {
    return judge_events({seen}, {}).at(0);
  };
  AttachedDevice device = said(wheel());
  EXPECT_EQ(device.driver, "evdev");
  EXPECT_EQ(device.name, "OpenFFBoard, /dev/input/event7");
  EXPECT_THAT(device.use, HasSubstr("event_axes = 1"));
  EXPECT_THAT(device.problem, IsEmpty());
  haptics::EventDeviceSeen seen = wheel();
  seen.facts.has_springs = false;
  EXPECT_THAT(said(seen).problem, HasSubstr("it renders constant forces only"));
  seen = wheel();
  seen.remedy = "sudo reckon devices --install-rule";
  EXPECT_EQ(said(seen).problem, "this user may not open it");
  EXPECT_EQ(said(seen).remedy, seen.remedy);
  seen = wheel();
  seen.problem = "Input/output error";
  EXPECT_THAT(said(seen).problem, HasSubstr("Input/output error"));
}

TEST(AttachedDevices, ReportABoardThatIsNoGameController) {
  UsbDeviceSeen board;
  board.vendor = 0x1209;
  board.product = 0xffb0;
  ASSERT_EQ(judge_events({}, {hub(), board}).size(), 1U);
  EXPECT_THAT(judge_events({}, {board}).at(0).remedy, HasSubstr("game controller"));
  EXPECT_EQ(judge_events({wheel()}, {board}).size(), 1U);
  EXPECT_THAT(judge_events({}, {hub()}), IsEmpty());
}

TEST(AttachedDevices, ReportMissingPermissionWithTheRemedy) {
  UsbDeviceSeen seen = falcon(false);
  seen.is_denied = true;
  const UsbLook look = judge_usb({seen}, {}, false);
  ASSERT_EQ(look.devices.size(), 1U);
  EXPECT_EQ(look.devices[0].problem, "this user may not open it");
  EXPECT_THAT(look.devices[0].remedy, HasSubstr("--install-rule"));
}

TEST(AttachedDevices, ReportOtherProblems) {
  UsbDeviceSeen seen = falcon(false);
  seen.problem = "Input/Output Error";
  EXPECT_THAT(judge_usb({seen}, {}, false).devices.at(0).problem, HasSubstr("Input/Output Error"));
  const auto said = [](const std::string& sentence) {
    const std::array problems{UsbProblem{"falcon", sentence}};
    return judge_usb({falcon(true)}, problems, false).devices.at(0).problem;
  };
  EXPECT_THAT(said("Falcon: it has lost its firmware"), HasSubstr("lost its firmware"));
  EXPECT_THAT(said("Falcon: another program uses it: Resource busy"), HasSubstr("another program"));
  EXPECT_THAT(said("Falcon: not homed: pull the handle out"), HasSubstr("pull the handle out"));
}

TEST(AttachedDevices, MissingUsbDiffersFromMissingDevices) {
  EXPECT_THAT(judge_usb({}, {}, false).problem, HasSubstr("/dev/bus/usb"));
  EXPECT_THAT(judge_usb({hub()}, {}, false).problem, IsEmpty());
}

// The rule contains the numbers of the drivers; udev writes them in lower case.
TEST(AttachedDevices, RuleIsWrittenToTheGivenFolder) {
  const test::ScratchFolder folder;
  const auto written = run_reckon({"devices", "--install-rule", "--folder", folder.file(".")});
  EXPECT_EQ(written.status, 0) << written.err;
  std::ifstream file(folder.file(kRuleFile));
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, udev_rule());
  EXPECT_THAT(text, HasSubstr("ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\""));
  EXPECT_THAT(text, HasSubstr("ATTR{idVendor}==\"1234\", ATTR{idProduct}==\"0006\""));
  EXPECT_THAT(text, HasSubstr("TAG+=\"uaccess\""));
  EXPECT_THAT(text, HasSubstr("ATTRS{capabilities/ff}==\"*[1-9a-f]*\""));
}

TEST(AttachedDevices, RuleNamesDevicesWithoutAKernelDriver) {
  EXPECT_THAT(peer::evdev_udev({}), Not(HasSubstr("hidraw")));
  EXPECT_THAT(peer::evdev_udev({{0x346E, 0x0006}}),
              HasSubstr("SUBSYSTEM==\"hidraw\", ATTRS{idVendor}==\"346e\", "
                        "ATTRS{idProduct}==\"0006\", MODE="));
}

TEST(AttachedDevices, UnwritableRuleReportsTheCause) {
  const auto refused = run_reckon({"devices", "--install-rule", "--folder", "/no/such/folder"});
  EXPECT_NE(refused.status, 0);
  EXPECT_THAT(refused.err, HasSubstr("sudo"));
  EXPECT_EQ(run_reckon({"devices", "--folder", "/tmp"}).status, 2);
  EXPECT_EQ(run_reckon({"devices", "--install-rule", "--json"}).status, 2);
}

// A line that is open in this program, a free one, and a removed one.
TEST(AttachedDevices, SerialLinesAreListedWithTheirProblems) {
  const test::ScratchFolder folder;
  const int used = posix_openpt(O_RDWR | O_NOCTTY), free = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(used >= 0 && grantpt(used) == 0 && unlockpt(used) == 0);
  ASSERT_TRUE(free >= 0 && grantpt(free) == 0 && unlockpt(free) == 0);
  const auto name = [](int far) {
    std::array<char, 64> text{};
    return ptsname_r(far, text.data(), text.size()) == 0 ? std::string(text.data()) : "";
  };
  const int near = open(name(used).c_str(), O_RDWR | O_NOCTTY);
  ASSERT_GE(near, 0);
  std::filesystem::create_symlink(name(used), folder.file("a_used"));
  std::filesystem::create_symlink(name(free), folder.file("b_free"));
  std::filesystem::create_symlink(folder.file("nothing"), folder.file("c_gone"));
  const auto lines = peer::look_at_serial_lines(folder.file("."));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].driver, "serial");
  EXPECT_THAT(lines[0].problem, HasSubstr("another program uses it: tools_tests, process " +
                                          std::to_string(getpid())));
  EXPECT_EQ(lines[1].name, "b_free, " + name(free));
  EXPECT_THAT(lines[1].use, HasSubstr("reckon demo --device " + folder.file("./b_free")));
  EXPECT_THAT(lines[1].problem, IsEmpty());
  EXPECT_THAT(lines[2].problem, HasSubstr("its link leads to no device"));
  EXPECT_THAT(peer::look_at_serial_lines(folder.file("none")), IsEmpty());
  for (const int descriptor : {near, used, free}) close(descriptor);
}

TEST(AttachedDevices, ForbiddenSerialLineNamesItsGroup) {
  if (geteuid() == 0) GTEST_SKIP() << "root may open everything";
  const test::ScratchFolder folder;
  std::ofstream(folder.file("tty")) << "x";
  std::filesystem::permissions(folder.file("tty"), std::filesystem::perms::none);
  const auto lines = peer::look_at_serial_lines(folder.file("."));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].problem, "this user may not open it");
  EXPECT_THAT(lines[0].remedy, HasSubstr("usermod -aG dialout"));
}

TEST(AttachedDevices, VerbReportsThisHost) {
  const UsbLook look = look_at_usb(false);
  const auto result = run_reckon({"devices"});
  if (!look.problem.empty() && peer::look_at_serial_lines().empty()) {
    EXPECT_NE(result.status, 0);
    EXPECT_THAT(result.err, HasSubstr(look.problem));
  } else {
    EXPECT_THAT(result.err, HasSubstr("drivers: falcon, polhem, evdev, serial"));
  }
  EXPECT_THAT(run_reckon({"doctor", "--iface", "lo"}).out, HasSubstr("USB"));
}

}  // namespace
}  // namespace reckon::tools

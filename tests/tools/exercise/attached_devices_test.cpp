// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What is said of devices on USB, of ours and of others.
#include "reckon/tools/exercise/attached_devices.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <string>
#include <vector>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/exercise/attached_events.hpp"
#include "reckon/tools/exercise/attached_events.hpp"

namespace reckon::tools {
namespace {

using haptics::UsbDeviceSeen;
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

TEST(AttachedDevices, SayHowAFalconWouldBeUsed) {
  const UsbLook look = judge_usb({hub(), falcon(true)}, {"Falcon: ready: forces are shown"});
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

TEST(AttachedDevices, SayHowAPolhemWouldBeUsedAndWhatIsInTheWay) {
  const UsbLook ready = judge_usb({polhem(true)}, {"Polhem: ready: forces are shown"});
  ASSERT_EQ(ready.devices.size(), 1U);
  EXPECT_EQ(ready.devices[0].driver, "polhem");
  EXPECT_EQ(ready.devices[0].name, "Polhem, /dev/bus/usb/002/017");
  EXPECT_THAT(ready.devices[0].use, HasSubstr("--device polhem"));
  EXPECT_THAT(ready.devices[0].problem, IsEmpty());
  // Beside a Falcon, each has its own.
  const UsbLook both =
      judge_usb({falcon(true), polhem(true)},
                {"Falcon: ready: forces are shown", "Polhem: not homed: hold it straight ahead"});
  ASSERT_EQ(both.devices.size(), 2U);
  EXPECT_THAT(both.devices[0].problem, IsEmpty());
  EXPECT_THAT(both.devices[1].problem, HasSubstr("not homed"));
  UsbDeviceSeen denied = polhem(false);
  denied.is_denied = true;
  EXPECT_THAT(judge_usb({denied}, {}).devices.at(0).remedy, HasSubstr("--install-rule"));
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

TEST(AttachedDevices, SayHowAnEventDeviceWouldBeUsedAndWhatIsInTheWay) {
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
  EXPECT_THAT(said(seen).problem, HasSubstr("only forces that it is told"));
  seen = wheel();
  seen.is_denied = true;
  EXPECT_THAT(said(seen).remedy, HasSubstr("--install-rule"));
  seen = wheel();
  seen.problem = "Input/output error";
  EXPECT_THAT(said(seen).problem, HasSubstr("Input/output error"));
}

TEST(AttachedDevices, ABoardWithoutItsKernelsDriverIsTold) {
  UsbDeviceSeen board;
  board.vendor = 0x1209;
  board.product = 0xffb0;
  ASSERT_EQ(judge_events({}, {hub(), board}).size(), 1U);
  EXPECT_THAT(judge_events({}, {board}).at(0).remedy, HasSubstr("CONFIG_HID_PID"));
  EXPECT_EQ(judge_events({wheel()}, {board}).size(), 1U);
  EXPECT_THAT(judge_events({}, {hub()}), IsEmpty());
}

TEST(AttachedDevices, SayWhoMayNotOpenItAndTheRemedy) {
  UsbDeviceSeen seen = falcon(false);
  seen.is_denied = true;
  const UsbLook look = judge_usb({seen}, {});
  ASSERT_EQ(look.devices.size(), 1U);
  EXPECT_EQ(look.devices[0].problem, "this user may not open it");
  EXPECT_THAT(look.devices[0].remedy, HasSubstr("--install-rule"));
}

TEST(AttachedDevices, SayWhatElseIsInTheWay) {
  UsbDeviceSeen seen = falcon(false);
  seen.problem = "Input/Output Error";
  EXPECT_THAT(judge_usb({seen}, {}).devices.at(0).problem, HasSubstr("Input/Output Error"));
  const auto said = [](const std::string& sentence) {
    return judge_usb({falcon(true)}, {sentence}).devices.at(0).problem;
  };
  EXPECT_THAT(said("Falcon: it has no firmware, which it forgets"), HasSubstr("no firmware"));
  EXPECT_THAT(said("Falcon: another program has it: Resource busy"), HasSubstr("another program"));
  EXPECT_THAT(said("Falcon: not homed: pull the handle out"), HasSubstr("pull the handle out"));
}

TEST(AttachedDevices, AHostWithoutUsbIsNoHostWithoutDevices) {
  EXPECT_THAT(judge_usb({}, {}).problem, HasSubstr("/dev/bus/usb"));
  EXPECT_THAT(judge_usb({hub()}, {}).problem, IsEmpty());
}

// The numbers of the rule are those of the driver, and udev writes them in lower case.
TEST(AttachedDevices, TheRuleIsWrittenWhereItIsAskedFor) {
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

TEST(AttachedDevices, ARuleThatCannotBeWrittenSaysWhy) {
  const auto refused = run_reckon({"devices", "--install-rule", "--folder", "/no/such/folder"});
  EXPECT_NE(refused.status, 0);
  EXPECT_THAT(refused.err, HasSubstr("sudo"));
  EXPECT_EQ(run_reckon({"devices", "--folder", "/tmp"}).status, 2);
  EXPECT_EQ(run_reckon({"devices", "--install-rule", "--json"}).status, 2);
}

TEST(AttachedDevices, TheVerbTellsOfThisHost) {
  const UsbLook look = look_at_usb(false);
  const auto result = run_reckon({"devices"});
  if (!look.problem.empty()) {
    EXPECT_NE(result.status, 0);
    EXPECT_THAT(result.err, HasSubstr(look.problem));
  } else {
    EXPECT_THAT(result.err, HasSubstr("drivers: falcon, polhem, evdev"));
  }
  EXPECT_THAT(run_reckon({"doctor", "--iface", "lo"}).out, HasSubstr("USB"));
}

}  // namespace
}  // namespace reckon::tools

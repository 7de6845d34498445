// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data read from folders of the kernel, and the calls for which plain files suffice. For the others
// see hid_kernel_test.cpp.
#include "reckon/haptics/hid/hid_calls.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(KernelHidCalls, ListDevicesInNumericOrder) {
  const test::ScratchFolder folder;
  for (const char* name : {"hidraw10", "hidraw2", "hidraw", "event3"})
    std::ofstream(folder.file(name)) << "";
  EXPECT_THAT(kernel_hid_calls(folder.file("."))->paths(),
              ElementsAre(folder.file("./hidraw2"), folder.file("./hidraw10")));
  EXPECT_THAT(kernel_hid_calls("/no/such/folder")->paths(), IsEmpty());
}

// As in /sys: a USB interface, its HID device, and the latter as a raw device.
class Facts : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(hid);
    fs::create_directories(folder.file("hidraw3"));
    fs::create_directory_symlink(hid, folder.file("hidraw3/device"));
  }
  void effects(const std::string& input, const char* bits) {
    fs::create_directories(hid / "input" / input / "capabilities");
    std::ofstream(hid / "input" / input / "capabilities" / "ff") << bits << '\n';
  }

  test::ScratchFolder folder;
  fs::path usb = folder.file("usb"), hid = usb / "hid";
  std::unique_ptr<HidCalls> calls = kernel_hid_calls("/dev", folder.file("."));
};

TEST_F(Facts, DeviceHasItsNameNumbersAndDescriptor) {
  std::ofstream(hid / "uevent") << "DRIVER=hid-generic\nHID_ID=0003:00001209:0000FFB0\n"
                                   "HID_NAME=OpenFFBoard FFBoard\nHID_PHYS=usb-1\n";
  std::ofstream(hid / "report_descriptor", std::ios::binary) << '\x05' << '\0' << '\x0F';
  const HidSeen seen = calls->look("/dev/hidraw3");
  EXPECT_EQ(seen.name, "OpenFFBoard FFBoard");
  EXPECT_EQ(seen.vendor, 0x1209);
  EXPECT_EQ(seen.product, 0xFFB0);
  EXPECT_THAT(seen.descriptor, ElementsAre(5, 0, 15));
  EXPECT_FALSE(seen.kernel_has_springs);
  const HidSeen none = calls->look("/dev/hidraw4");
  EXPECT_EQ(none.name, "");
  EXPECT_THAT(none.descriptor, IsEmpty());
}

// FF_SPRING is bit 83, FF_GAIN 96, FF_CONSTANT 82.
TEST_F(Facts, KernelDrivesADeviceWithSpringEffects) {
  const auto has_springs = [&] { return calls->look("/dev/hidraw3").kernel_has_springs; };
  for (const char* bits : {"0", "100000000 0", "100040000 0", "80000"}) {
    effects("input7", bits);
    EXPECT_FALSE(has_springs()) << bits;
  }
  effects("input8", "80000 0");
  EXPECT_TRUE(has_springs());
  effects("input8", "1000f0000 0");
  EXPECT_TRUE(has_springs());
}

TEST_F(Facts, ReportIntervalIsReadFromTheEndpoint) {
  EXPECT_EQ(calls->report_intervals("/dev/hidraw3").takes.count(), 0);
  fs::create_directories(usb / "ep_01");
  std::ofstream(usb / "ep_01" / "direction") << "out\n";
  std::ofstream(usb / "ep_01" / "interval") << "2ms\n";
  EXPECT_EQ(calls->report_intervals("/dev/hidraw3").takes.count(), 2000);
}

TEST(KernelHidCalls, RefuseAFileTakenByAnotherProgram) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("hidraw3");
  std::ofstream(path) << "ab";
  const auto calls = kernel_hid_calls();
  const int one = calls->open(path), other = calls->open(path);
  ASSERT_GE(one, 0);
  ASSERT_GE(other, 0);
  EXPECT_EQ(calls->take(one), 0);
  EXPECT_EQ(calls->take(other), -EBUSY);
  calls->close(one);
  EXPECT_EQ(calls->take(other), 0);
  std::array<std::uint8_t, 8> report{};
  EXPECT_EQ(calls->read(other, report), 2);
  EXPECT_EQ(report[1], 'b');
  EXPECT_EQ(calls->read(other, report), -ENODEV) << "it has ended";
  EXPECT_FALSE(calls->is_there(other)) << "a plain file answers no question of hidraw";
  EXPECT_EQ(calls->get_feature(other, report), -ENOTTY);
  calls->close(other);
  EXPECT_EQ(calls->open(folder.file("none")), -ENOENT);
}

}  // namespace
}  // namespace reckon::haptics

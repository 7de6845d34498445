// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The real calls, on folders and pipes of the test's own.
#include "reckon/haptics/evdev/event_calls.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(KernelEventCalls, ListEventDevicesInNumericOrder) {
  const test::ScratchFolder folder;
  for (const char* name : {"event10", "event2", "mouse0", "event", "event3x", "js1"})
    std::ofstream(folder.file(name)) << "";
  EXPECT_THAT(kernel_event_calls(folder.file("."))->paths(),
              ElementsAre(folder.file("./event2"), folder.file("./event10")));
  EXPECT_THAT(kernel_event_calls("/no/such/folder")->paths(), IsEmpty());
}

TEST(KernelEventCalls, NameAClosedForceFeedbackDevice) {
  const test::ScratchFolder folder;
  const auto describe = [&](const std::string& event, const char* effects) {
    const std::filesystem::path device = folder.file(event + "/device");
    std::filesystem::create_directories(device / "capabilities");
    std::ofstream(device / "capabilities" / "ff") << effects << '\n';
    std::ofstream(device / "name") << "Some wheel\n";
  };
  describe("event1", "0");
  describe("event2", "3003000000000 0");
  describe("event3", "0 0");
  const auto calls = kernel_event_calls("/dev/input", folder.file("."));
  EXPECT_EQ(calls->closed_name("/dev/input/event1"), "");
  EXPECT_EQ(calls->closed_name("/dev/input/event2"), "Some wheel");
  EXPECT_EQ(calls->closed_name("/dev/input/event3"), "");
  EXPECT_EQ(calls->closed_name("/dev/input/event4"), "");
}

TEST(KernelEventCalls, ReadReportIntervalsFromEndpoints) {
  const test::ScratchFolder folder;
  namespace fs = std::filesystem;
  // As in /sys: a USB interface, its HID device, and the input device of the latter.
  const fs::path usb = folder.file("usb"), input = usb / "hid" / "input";
  fs::create_directories(input);
  fs::create_directories(folder.file("event3"));
  fs::create_directory_symlink(usb / "hid", input / "device");
  fs::create_directory_symlink(input, folder.file("event3/device"));
  const auto calls = kernel_event_calls("/dev/input", folder.file("."));
  const auto say = [&](const std::string& end, const char* direction, const char* interval) {
    fs::create_directories(usb / end);
    std::ofstream(usb / end / "direction") << direction << '\n';
    std::ofstream(usb / end / "interval") << interval << '\n';
    return calls->report_intervals("/dev/input/event3").takes.count();
  };
  EXPECT_EQ(calls->report_intervals("/dev/input/event3").takes.count(), 0);
  EXPECT_EQ(say("ep_81", "in", "2ms"), 0);
  EXPECT_EQ(calls->report_intervals("/dev/input/event3").sends.count(), 2000);
  EXPECT_EQ(say("ep_01", "out", "4ms"), 4000);
  EXPECT_EQ(say("ep_01", "out", "125us"), 125);
  for (const char* none : {"", "ms", "-1ms", "3", "3 ms", "99999999999999999999ms", "20000ms"})
    EXPECT_EQ(say("ep_01", "out", none), 0) << none;
  EXPECT_EQ(calls->report_intervals("/dev/input/event3").sends.count(), 2000);
  EXPECT_EQ(calls->report_intervals("/dev/input/event4").takes.count(), 0);
}

class KernelEventPipe : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
    file_ = calls_->open(path_);
    ASSERT_GE(file_, 0);
  }
  void TearDown() override { calls_->close(file_); }

  test::ScratchFolder folder_;
  std::string path_ = folder_.file("event0");
  std::unique_ptr<EventCalls> calls_ = kernel_event_calls();
  std::array<input_event, 4> events_{};
  int file_ = -1;
};

TEST_F(KernelEventPipe, RestoresWrittenEvents) {
  EXPECT_EQ(calls_->read(file_, events_), -EAGAIN);
  input_event event{};
  event.type = EV_FF;
  event.code = 3;
  event.value = 7;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(calls_->write(file_, event), 0);
  ASSERT_EQ(calls_->read(file_, events_), 2);
  EXPECT_EQ(events_[1].type, EV_FF);
  EXPECT_EQ(events_[1].code, 3);
  EXPECT_EQ(events_[1].value, 7);
  EXPECT_EQ(calls_->read(file_, events_), -EAGAIN);
}

TEST_F(KernelEventPipe, PartialEventIsNoEvent) {
  const std::array<char, 30> octets{};
  ASSERT_EQ(::write(file_, octets.data(), octets.size()), 30);
  EXPECT_EQ(calls_->read(file_, events_), -EIO);
}

TEST_F(KernelEventPipe, RefusesCallsToANonEventDevice) {
  ff_effect effect{};
  EXPECT_EQ(calls_->control(file_, EVIOCSFF, &effect), -ENOTTY);
}

TEST(KernelEventCalls, ReportEndedAndMissingFiles) {
  const test::ScratchFolder folder;
  const auto calls = kernel_event_calls();
  EXPECT_EQ(calls->open(folder.file("event0")), -ENOENT);
  std::ofstream(folder.file("event0")) << "";
  const int file = calls->open(folder.file("event0"));
  ASSERT_GE(file, 0);
  std::array<input_event, 1> events{};
  EXPECT_EQ(calls->read(file, events), -ENODEV);
  calls->close(file);
  EXPECT_EQ(calls->read(file, events), -EBADF);
}

}  // namespace
}  // namespace reckon::haptics

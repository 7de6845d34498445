// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program itself with a Falcon on the USB of a real kernel: from a device without permission to
// a wall that is felt. One Falcon serves all tests, in their order. An emulated machine is slow and
// uneven: measured times are printed, and judged only by seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <Eigen/Core>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/haptics/support/usbip_falcon.hpp"
#include "reckon/tests/haptics/support/vm_program.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr uid_t kUser = 1000;
constexpr const char* kFirmware = "/tmp/firmware.bin";
// The hand above the floor at z = 0 of its scene, and its goal when it presses.
const Vector3d kAbove(0, 0, 0.02), kBelow(0, 0, -0.02);

class FalconVm : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!std::filesystem::exists(UsbipDevice::kBus) || !std::filesystem::exists(kProgram)) return;
    FalconModelOptions options;
    options.has_firmware = options.homed = false;
    options.firmware.resize(4000);
    for (std::size_t i = 0; i < options.firmware.size(); ++i)
      options.firmware[i] = static_cast<std::uint8_t>(37 * i + i / 251);
    std::ofstream(kFirmware, std::ios::binary)
        .write(reinterpret_cast<const char*>(options.firmware.data()),
               static_cast<std::streamsize>(options.firmware.size()));
    falcon = std::make_unique<UsbipFalcon>(options, kAbove);
    falcon->plug_in();
  }
  static void TearDownTestSuite() { falcon.reset(); }
  void SetUp() override {
    if (falcon == nullptr) GTEST_SKIP() << "runs in the virtual machine of ./run devices-vm alone";
  }

  static std::string list(uid_t user) {
    Program program({"devices"}, user);
    program.wait();
    std::string said = program.said();
    std::printf("%s", said.c_str());
    return said;
  }
  static double force() {
    return falcon->with([](FalconModel& one) { return one.force().z(); });
  }
  static bool rests() {
    return falcon->with(
        [](FalconModel& one) { return one.motors() == std::array<std::int16_t, 3>{}; });
  }
  // The effect of udev with the rule installed, for this machine has no udev.
  static void let_users_open_it() {
    for (const auto& node : std::filesystem::directory_iterator("/dev/bus/usb/001"))
      std::filesystem::permissions(node, static_cast<std::filesystem::perms>(0666));
  }
  static void expect_the_floor() {
    falcon->go(kBelow);
    EXPECT_TRUE(comes_true([] { return force() > 1; })) << force() << " N";
    std::printf("  pressed: %.2f N\n", force());
    falcon->go(kAbove);
    EXPECT_TRUE(comes_true([] { return rests(); })) << force() << " N";
  }
  static std::unique_ptr<Program> start() {
    auto program = std::make_unique<Program>(
        std::vector<std::string>{"peer", "/floor.toml", "--iface", "lo", "--json", "--for", "600s"},
        kUser);
    const bool is_ready = comes_true([&] {
      // The action requested of its user.
      if (program->has_said("not homed")) falcon->with([](FalconModel& one) { one.home(); });
      return program->has_said("ready: forces are active");
    });
    EXPECT_TRUE(is_ready) << program->said();
    return is_ready ? std::move(program) : nullptr;
  }
  static std::unique_ptr<UsbipFalcon> falcon;
};

std::unique_ptr<UsbipFalcon> FalconVm::falcon;

TEST_F(FalconVm, UserWithoutPermissionGetsTheRule) {
  std::string said;
  ASSERT_TRUE(comes_true([&] {
    said = list(kUser);
    return said.find("Novint Falcon") != said.npos;
  }));
  EXPECT_THAT(said, AllOf(HasSubstr("this user may not open it"),
                          HasSubstr("fix: sudo reckon devices --install-rule"),
                          HasSubstr("ATTR{idProduct}==\"cb48\"")));
  std::filesystem::create_directories("/tmp/rules.d");
  Program install({"devices", "--install-rule", "--folder", "/tmp/rules.d"});
  EXPECT_EQ(install.wait(), 0);
  EXPECT_THAT(install.said(), HasSubstr("is written; plug the device in again"));
}

TEST_F(FalconVm, ReportsThatItNeedsFirmware) {
  let_users_open_it();
  EXPECT_THAT(list(kUser), HasSubstr("firmware"));
}

TEST_F(FalconVm, FloorIsFeltAfterHoming) {
  const auto program = start();
  ASSERT_NE(program, nullptr);
  for (int i = 0; i < 3; ++i) expect_the_floor();
  falcon->go(kBelow);
  EXPECT_TRUE(comes_true([] { return force() > 1; }));
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  EXPECT_TRUE(rests()) << "its motors are on after the program's end";
  std::printf("%s", program->said().c_str());
  falcon->go(kAbove);
}

TEST_F(FalconVm, KilledProgramLeavesForceForATenthSecond) {
  const auto program = start();
  ASSERT_NE(program, nullptr);
  falcon->go(kBelow);
  EXPECT_TRUE(comes_true([] { return force() > 1; }));
  program->send(SIGKILL);
  std::printf("  killed: no force after %.1f ms\n", milliseconds_until([] { return rests(); }));
  program->wait();
  falcon->go(kAbove);
}

TEST_F(FalconVm, RecoversAfterAnUnplug) {
  const auto program = start();
  ASSERT_NE(program, nullptr);
  falcon->go(kBelow);
  EXPECT_TRUE(comes_true([] { return force() > 1; }));
  falcon->unplug();
  EXPECT_TRUE(rests());
  std::printf("  unplugged: said after %.1f ms\n",
              milliseconds_until([&] { return program->has_said("was unplugged"); }));
  falcon->go(kAbove);
  falcon->plug_in();
  EXPECT_TRUE(comes_true([&] {
    let_users_open_it();
    return falcon->with([](FalconModel& one) { return one.has_firmware(); });
  })) << program->said();
  falcon->with([](FalconModel& one) { one.home(); });
  expect_the_floor();
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  std::printf("%s", program->said().c_str());
}

// After all of the above.
TEST_F(FalconVm, NeverGaveUnpaidEnergy) {
  falcon->with([](FalconModel& one) {
    std::printf("  the hand put in %.6f J\n", one.port_work() + one.damping_loss());
    EXPECT_GE(one.port_work() + one.damping_loss(), -1e-6);
  });
}

}  // namespace
}  // namespace reckon::test

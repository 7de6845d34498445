// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program itself at a wheel whose springs the kernel does not drive, for its descriptor has no
// dead band, through hidraw. One wheel and one boot serve all tests, in their order. Time is that
// of an emulated machine: what takes long is told, and judged by seconds alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/tests/haptics/support/usbip_wheel.hpp"
#include "reckon/tests/haptics/support/vm_program.hpp"

namespace reckon::test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::Not;

// Of the scene: a wall whose outside is where x is greater, and where the hand goes [m].
constexpr double kStiffness = 700;  // [N/m]
constexpr double kWall = -0.00513, kOutside = 0.04, kInside = -0.035;
// Where a hand of 300 N/m rests that wants to be there.
constexpr double kRest = kWall + (kInside - kWall) * 300 / (300 + kStiffness);
constexpr uid_t kSomebody = 1000;

class HidVm : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!std::filesystem::exists(UsbipDevice::kBus) || !std::filesystem::exists(kProgram)) return;
    PidWheelOptions options;
    options.without = {0x65};
    wheel = std::make_unique<UsbipWheel>(options);
    go(kOutside);
    wheel->plug_in();
  }
  static void TearDownTestSuite() { wheel.reset(); }
  void SetUp() override {
    if (wheel == nullptr) GTEST_SKIP() << "runs in the virtual machine of ./run devices-vm alone";
  }

  template <class Use>
  static auto with(Use&& use) {
    return wheel->with(use);
  }
  static void go(double place) {
    with([&](PidWheel& one) { one.want(0, place); });
  }
  static double force() {
    return with([](PidWheel& one) { return one.force(0); });
  }
  static bool plays() {
    return with([](PidWheel& one) { return one.playing() == 2; });
  }
  static std::size_t effects() {
    return with([](PidWheel& one) { return one.effects(); });
  }
  static bool rests_at(double goal, double within) {
    return with([&](PidWheel& one) {
      return std::abs(one.speed(0)) < 1e-5 && std::abs(one.place(0) - goal) < within;
    });
  }
  static void retreat() {
    go(kOutside);
    ASSERT_TRUE(comes_true([] { return rests_at(kOutside, 0.001); }));
    EXPECT_EQ(force(), 0);
  }
  static void press() {
    go(kInside);
    ASSERT_TRUE(comes_true([] { return rests_at(kRest, 1e-4); })) << force() << " N";
    const auto [at, shown] =
        with([](PidWheel& one) { return std::pair(one.place(0), one.force(0)); });
    const double depth = kWall - at;
    // What the reports round off: 12.5 um of its place and 0.2 N/m of its stiffness.
    EXPECT_NEAR(shown, kStiffness * depth, kStiffness * 12.5e-6 + 0.2 * depth);
    std::printf("  %.4f N at %.4f mm in the wall: %.3f N/m of %.0f\n", shown, 1e3 * depth,
                shown / depth, kStiffness);
  }
  static std::unique_ptr<Program> start() {
    auto program = std::make_unique<Program>(std::vector<std::string>{
        "peer", "/wall.toml", "--iface", "lo", "--device", "evdev", "--json", "--for", "600s"});
    EXPECT_TRUE(comes_true([] { return plays(); })) << program->said();
    std::this_thread::sleep_for(milliseconds(500));  // its greatest force has risen
    return program;
  }

  static std::unique_ptr<UsbipWheel> wheel;
};

std::unique_ptr<UsbipWheel> HidVm::wheel;

TEST_F(HidVm, TheKernelDoesNotDriveItsSpringsAndReckonSaysHowItIsUsed) {
  ASSERT_TRUE(comes_true([] { return std::filesystem::exists("/dev/hidraw0"); }));
  Program program({"devices"});
  EXPECT_EQ(program.wait(), 0);
  std::printf("%s", program.said().c_str());
  EXPECT_THAT(program.said(), HasSubstr(UsbipWheel::kProduct + std::string(", /dev/hidraw0")));
  EXPECT_THAT(program.said(), HasSubstr("renders walls by itself along an axis"));
  EXPECT_THAT(program.said(), Not(HasSubstr("/dev/input/event")));
}

TEST_F(HidVm, WhoMayNotOpenItIsToldTheRuleThatNamesIt) {
  Program program({"devices"}, kSomebody);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.said(), HasSubstr("this user may not open it"));
  EXPECT_THAT(program.said(), HasSubstr("--install-rule while it is plugged in"));
  std::filesystem::create_directories("/tmp/rules.d");
  Program install({"devices", "--install-rule", "--folder", "/tmp/rules.d"});
  EXPECT_EQ(install.wait(), 0);
  std::ostringstream rule;
  rule << std::ifstream("/tmp/rules.d/70-reckon.rules").rdbuf();
  EXPECT_THAT(rule.str(), HasSubstr("SUBSYSTEM==\"hidraw\", ATTRS{idVendor}==\"1209\", "
                                    "ATTRS{idProduct}==\"ffb0\""));
}

TEST_F(HidVm, AWallIsRenderedWithItsStiffness) {
  const auto program = start();
  for (int i = 0; i < 4; ++i) {
    press();
    retreat();
  }
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  std::printf("%s", program->said().c_str());
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
}

TEST_F(HidVm, OneThatIsKilledLeavesNoForceAndTheNextBeginsAnew) {
  auto program = start();
  press();
  program->send(SIGKILL);
  const double took = milliseconds_until([] { return force() == 0; });
  std::printf("  killed: no force after %.1f ms\n", took);
  EXPECT_EQ(program->wait(), 128 + SIGKILL);
  EXPECT_EQ(effects(), 2U) << "nobody erases them";
  retreat();
  program = start();
  EXPECT_EQ(effects(), 2U) << "its own";
  press();
  retreat();
}

TEST_F(HidVm, UnpluggedItShowsNothingAndIsTakenUpAgain) {
  const auto program = start();
  press();
  wheel->unplug();
  const double said = milliseconds_until([&] { return program->has_said("was unplugged"); });
  if (!program->has_said("was unplugged")) std::printf("%s", program->said().c_str());
  std::printf("  unplugged: said after %.1f ms\n", said);
  retreat();
  wheel->plug_in();
  const double took = milliseconds_until([] { return plays(); });
  std::printf("  plugged in again: set up after %.0f ms\n", took);
  press();
  retreat();
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0) << program->said();
}

// All that was done to it.
TEST_F(HidVm, TheWheelNeverGaveMoreEnergyThanTheHandPutIn) {
  with([](PidWheel& one) {
    std::printf("  %.6f J taken, %.3g J at least; %d changes\n", one.absorbed(),
                one.least_absorbed(), one.changes());
    EXPECT_GE(one.least_absorbed(), -1e-6);
    EXPECT_EQ(one.strange(), 0);
  });
}

}  // namespace
}  // namespace reckon::test

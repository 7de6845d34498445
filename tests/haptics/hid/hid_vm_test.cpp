// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program itself with a wheel whose springs the kernel does not drive, because its descriptor
// has no dead band, through hidraw. One wheel and one boot serve all tests, in their order.
// Measured times of the emulated machine are printed, and judged only by seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "reckon/tests/haptics/support/vm_wheel.hpp"

namespace reckon::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr uid_t kSomebody = 1000;

class HidVm : public VmWheel {
 protected:
  static void SetUpTestSuite() {
    PidWheelOptions options;
    options.without = {0x65};
    plug_in(options);
  }
};

TEST_F(HidVm, KernelDrivesNoSpringsAndReckonListsIt) {
  ASSERT_TRUE(comes_true([] { return std::filesystem::exists("/dev/hidraw0"); }));
  Program program({"devices"});
  EXPECT_EQ(program.wait(), 0);
  std::printf("%s", program.said().c_str());
  EXPECT_THAT(program.said(), HasSubstr(UsbipWheel::kProduct + std::string(", /dev/hidraw0")));
  EXPECT_THAT(program.said(), HasSubstr("renders walls itself along one axis"));
  EXPECT_THAT(program.said(), Not(HasSubstr("/dev/input/event")));
}

TEST_F(HidVm, UserWithoutPermissionGetsTheRule) {
  Program program({"devices"}, kSomebody);
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.said(), HasSubstr("this user may not open it"));
  EXPECT_THAT(program.said(), HasSubstr("--install-rule while it is attached"));
  std::filesystem::create_directories("/tmp/rules.d");
  Program install({"devices", "--install-rule", "--folder", "/tmp/rules.d"});
  EXPECT_EQ(install.wait(), 0);
  std::ostringstream rule;
  rule << std::ifstream("/tmp/rules.d/70-reckon.rules").rdbuf();
  EXPECT_THAT(rule.str(), HasSubstr("SUBSYSTEM==\"hidraw\", ATTRS{idVendor}==\"1209\", "
                                    "ATTRS{idProduct}==\"ffb0\""));
}

TEST_F(HidVm, WallIsRenderedWithItsStiffness) {
  const auto program = start();
  for (int i = 0; i < 4; ++i) {
    press();
    expect_the_wall();
    retreat();
  }
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0);
  std::printf("%s", program->said().c_str());
  EXPECT_TRUE(comes_true([] { return effects() == 0; }));
}

TEST_F(HidVm, KilledProgramLeavesNoForceAndNextRestarts) {
  auto program = start();
  press();
  expect_the_wall();
  program->send(SIGKILL);
  const double took = milliseconds_until([] { return force() == 0; });
  std::printf("  killed: no force after %.1f ms\n", took);
  EXPECT_EQ(program->wait(), 128 + SIGKILL);
  EXPECT_EQ(effects(), 2U) << "nobody erases them";
  retreat();
  program = start();
  EXPECT_EQ(effects(), 2U) << "its own";
  press();
  expect_the_wall();
  retreat();
}

TEST_F(HidVm, RecoversAfterAnUnplug) {
  const auto program = start();
  press();
  expect_the_wall();
  wheel->unplug();
  const double said = milliseconds_until([&] { return program->has_said("was unplugged"); });
  if (!program->has_said("was unplugged")) std::printf("%s", program->said().c_str());
  std::printf("  unplugged: said after %.1f ms\n", said);
  retreat();
  wheel->plug_in();
  const double took = milliseconds_until([] { return playing() == 2; });
  std::printf("  plugged in again: set up after %.0f ms\n", took);
  press();
  expect_the_wall();
  retreat();
  program->send(SIGINT);
  EXPECT_EQ(program->wait(), 0) << program->said();
}

TEST_F(HidVm, WheelNeverGaveUnpaidEnergy) { expect_no_energy_from_the_wheel(); }

}  // namespace
}  // namespace reckon::test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The instructions to the user before and after the measurement of a real device.
// measure_terminal.py tests the measurement itself, and so do the device models in
// tests/haptics/measurement.
#include "reckon/tools/exercise/real_measuring.hpp"

#include <gmock/gmock.h>

#include <string>

#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/exercise/device_measuring.hpp"

namespace reckon::tools {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(RealMeasuring, WarnsOfTheHandlesTravelAndForce) {
  haptics::DeviceLimits limits;
  limits.max_force = 2.0;
  EXPECT_THAT(warning_of(limits, true),
              AllOf(HasSubstr("Release the handle"), HasSubstr("by up to 40 mm, with up to 0.8 N"),
                    HasSubstr("Press Enter to begin")));
  limits.max_force = 100.0;
  EXPECT_THAT(warning_of(limits, false),
              AllOf(HasSubstr("with up to 3 N"), Not(HasSubstr("Enter"))));
}

MeasuredChain chain(double delay, int needed) {
  MeasuredChain chain;
  chain.found.damping = 0.5;
  chain.found.damping_error = 0.01;
  chain.found.delay = delay;
  chain.limits.damping = 0.9;
  chain.limits.delay_samples = 6;
  chain.needed_delay = needed;
  return chain;
}

TEST(RealMeasuring, DelayIsReportLatencyPlusMotorLag) {
  EXPECT_NEAR(delay_to_state(chain(6.3e-3, 4)), 4e-3, 1e-12) << "0.3 ms are the fit's error";
  EXPECT_NEAR(delay_to_state(chain(8.1e-3, 4)), 6.1e-3, 1e-12) << "a lag of 2.1 ms";
  EXPECT_NEAR(delay_to_state(chain(8.1e-3, 0)), 8.1e-3, 1e-12) << "no reports tell of themselves";
}

TEST(RealMeasuring, RemarksCompareAssumedAndMeasuredValues) {
  EXPECT_THAT(remarks_of(chain(8.1e-3, 4)),
              ElementsAre(AllOf(HasSubstr("assumed 0.9 N s/m; measured 0.5"), HasSubstr("LESS")),
                          AllOf(HasSubstr("assumed 6 ms; pushes were 8.1 ms late"),
                                HasSubstr("need 4 ms"))));
  MeasuredChain good = chain(6e-3, 0);
  good.found.damping = 1.0;
  EXPECT_THAT(remarks_of(good), ElementsAre(Not(HasSubstr("LESS")), Not(HasSubstr("need"))));
}

TEST(RealMeasuring, RemarksAreNoPartOfTheDescriptor) {
  peer::DeviceDescriptor known;
  haptics::MeasuredDevice found;
  found.damping = 0.5;
  found.mass = 0.2;
  const std::string text = descriptor_text("mine", known, found, {"one", "two"});
  EXPECT_THAT(text, StartsWith("# one\n# two\nname = \"mine\"\n"));
  EXPECT_NEAR(peer::parse_device_descriptor(text, "mine.toml").damping, 0.5, 1e-12);
}

// For a Falcon, whose position comes from three encoders.
TEST(RealMeasuring, KeepsTheKnownResolutionIfNoneIsFound) {
  peer::DeviceDescriptor known;
  known.resolution = 90e-6;
  haptics::MeasuredDevice found;
  found.damping = 0.5;
  found.mass = 0.2;
  const auto written = [&] {
    return peer::parse_device_descriptor(descriptor_text("mine", known, found, {}), "mine.toml")
        .resolution;
  };
  EXPECT_NEAR(written(), 90e-6, 1e-9);
  found.resolution = 20e-6;
  EXPECT_NEAR(written(), 20e-6, 1e-9);
}

TEST(RealMeasuring, RefusesDevicesThatTakeNoForce) {
  for (const char* name : {"evdev", "/dev/input/event4", "/dev/hidraw0"}) {
    const test::ProgramResult result = test::run_reckon({"devices", "measure", name, "--yes"});
    EXPECT_EQ(result.status, 2) << name;
    EXPECT_THAT(result.err, AllOf(HasSubstr(name), HasSubstr("renders springs itself")));
    EXPECT_EQ(result.out, "");
  }
  EXPECT_THAT(test::run_reckon({"devices", "measure", "falcon", "--max-force", "1 N", "--yes"}).err,
              HasSubstr("--max-force applies to serial boards only"));
  EXPECT_THAT(test::run_reckon({"devices", "measure"}).err, HasSubstr("needs a device"));
  EXPECT_THAT(test::run_reckon({"devices", "--yes"}).err, HasSubstr("--yes needs measure"));
  EXPECT_THAT(test::run_reckon({"devices", "measure", "m", "--simulate", "falcon", "--yes"}).err,
              HasSubstr("--yes needs a real device"));
}

}  // namespace
}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices behind the real libusb with everything that can be touched: walls, remote hands, effects,
// bodies, each at five delays. Energy by the models' own ledgers. RECKON_SOAK=1 draws 200 of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/usb_kinds.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::usb_touch_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::DrawnTouch;
using test::TouchKind;

int seeds() { return test::tries(1, 200); }

template <class Kind>
class UsbTouch : public testing::Test {};
TYPED_TEST_SUITE(UsbTouch, test::UsbKinds, test::UsbKindNames);

TYPED_TEST(UsbTouch, NeverGivesUnpaidEnergyForAnyTouch) {
  double least = 0, allowance = 0, felt = 0;
  for (const TouchKind kind : test::kTouchKinds) {
    double most_force = 0;
    for (int run = 0; run < seeds() * test::kUsbDelays; ++run) {
      const int delay = run % test::kUsbDelays;
      const auto seed = static_cast<unsigned>(1 + run);
      DrawnTouch touch(kind, seed);
      auto options = TypeParam::options(delay);
      options.seed = seed;
      options.mass = run % 3 == 0 ? 0.5 : 0.1;
      options.hand_stiffness = 50.0 * (1 + run * 7 % 12);
      options.hand_damping = run % 2 == 0 ? 0.5 : 3.0;
      UsbSettings settings;
      settings.damping = options.damping = 6.0;  // so that walls are felt
      settings.chain = test::usb_chain(delay);
      test::PluggedDevice<typename TypeParam::Model> plugged(
          options, [&](double t) { return touch.hand(t - 3.0); }, TypeParam::driver(),
          usb_limits(TypeParam::facts(), settings), touch.scene());
      plugged.run(milliseconds(900));
      plugged.begin_books();
      plugged.before_step = [&](nanoseconds now) {
        touch.play_others(plugged.servo, now - milliseconds(3000));
        most_force = std::max(most_force, plugged.last.force.norm());
      };
      plugged.run(milliseconds(7000));
      const std::string which = "kind " + std::to_string(static_cast<int>(kind)) + ", seed " +
                                std::to_string(seed) + ", delay " + std::to_string(delay);
      ASSERT_GE(plugged.least_books, -1e-9) << which;
      if (kind != TouchKind::bodies) {
        ASSERT_LE(plugged.last.port_energy - test::transferred(plugged.last),
                  plugged.books() + plugged.last.encoder_allowance + 1e-9)
            << which;
      }
      ASSERT_LE(plugged.last.trips, 1U) << which << ": before there was a device";
      least = std::min(least, plugged.least_own);
      allowance = std::max(allowance, plugged.last.encoder_allowance);
    }
    EXPECT_GT(most_force, 0.3) << "nothing is felt of kind " << static_cast<int>(kind);
    felt = std::max(felt, most_force);
  }
  std::printf("least %.3g J without the encoders' allowance of up to %.3g J; to %.1f N\n", least,
              allowance, felt);
}

}  // namespace
}  // namespace reckon::haptics::usb_touch_test

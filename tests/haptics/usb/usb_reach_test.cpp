// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Devices behind the real libusb over their whole reach and beyond, with friction in their joints:
// hands that roam, stroke and press where the force is cut, and everything that can be touched
// right there. Energy by the models' own ledgers, of torques and turns. RECKON_SOAK=1 draws 200 of
// each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/usb_kinds.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::usb_reach_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::DrawnTouch;
using test::TouchKind;

// Without the damping of each pose three of the first eight fail for a Falcon.
constexpr int kFirst = 24;
int runs() { return test::tries(8, 800); }

constexpr double kDamping = 6.0;  // [N s/m], of the handle in the middle of its work space
constexpr double kThere = 3.0, kLeaves = 7.5;  // [s]

/// Path of the hand: from the middle of the work space to a random place, where it roams or presses
/// the floor. In three of four runs the place has a random lever, up to the one at which the force
/// is cut; in the others the reach has just ended.
template <class Kind>
struct ReachingHand {
  ReachingHand(DrawnTouch& drawn, int run) : touch(drawn), presses(run % 2 == 1) {
    std::mt19937_64 random(static_cast<unsigned>(run));
    std::uniform_real_distribution<double> any(-1, 1);
    const double longer = 1.0 + (0.5 + 0.5 * any(random)) * (0.97 * Kind::kLongest - 1.0);
    const bool is_beyond = run % 8 >= 6;
    const double wanted = longer * Kind::lever(Vector3d::Zero());
    constexpr double kStep = 1e-3;  // [m]
    double lever = 0;
    do {
      const Vector3d way = Vector3d(any(random), any(random), any(random)).normalized();
      double far = 0;
      do {
        far += kStep;
        place = far * way;
        lever = Kind::lever(place);
      } while (lever > 0 && (is_beyond || lever < wanted));
    } while (lever == 0 && !is_beyond);
    wide = std::pow(3.0, any(random));
    quick = std::pow(2.0, any(random));
  }
  [[nodiscard]] Vector3d operator()(double t) const {
    const double share = std::clamp(std::min(t - 1.0, kLeaves + 1.0 - t), 0.0, 1.0);
    const bool is_pressed = presses && t > kThere + 1.0 && t < kLeaves;
    const Vector3d about =
        is_pressed ? Vector3d(0, 0, -0.01) : Vector3d(wide * touch.hand(quick * (t - kThere)));
    return share * share * (3 - 2 * share) * place + about;
  }

  DrawnTouch& touch;
  bool presses;
  Vector3d place;
  double wide, quick;
};

template <class Kind>
class UsbReach : public testing::Test {};
TYPED_TEST_SUITE(UsbReach, test::UsbKinds, test::UsbKindNames);

TYPED_TEST(UsbReach, NeverGivesUnpaidEnergyUpToItsReach) {
  double least = 0, allowance = 0, felt = 0, longest = 0;
  const double middle = TypeParam::lever(Vector3d::Zero());
  for (int run = kFirst; run < kFirst + runs(); ++run) {
    const auto kind = test::kTouchKinds[static_cast<std::size_t>(run / 2 % 4)];
    const int delay = run % test::kUsbDelays;
    DrawnTouch touch(kind, static_cast<unsigned>(1 + run));
    const ReachingHand<TypeParam> hand(touch, run);
    auto options = TypeParam::options(delay);
    options.seed = static_cast<unsigned>(1 + run);
    options.mass = run % 3 == 0 ? 0.5 : 0.1;
    options.hand_stiffness = 50.0 * (1 + run * 7 % 12);
    options.hand_damping = hand.presses ? 0.2 : 3.0;
    options.damping = 0;
    UsbSettings settings;
    settings.joint_damping = options.joint_damping = kDamping * middle * middle;
    settings.chain = test::usb_chain(delay);
    test::PluggedDevice<typename TypeParam::Model> plugged(options, hand, TypeParam::driver(),
                                                           usb_limits(TypeParam::facts(), settings),
                                                           touch.scene(), hand.place);
    plugged.run(milliseconds(900));
    plugged.begin_books();
    const std::string which = "run " + std::to_string(run);
    double above = 0;  // [J], of the servo's meter
    plugged.before_step = [&](nanoseconds now) {
      touch.play_others(plugged.servo, now - milliseconds(3000));
      felt = std::max(felt, plugged.last.force.norm());
      above = std::max(above, plugged.last.port_energy - test::transferred(plugged.last) -
                                  plugged.books() - plugged.last.encoder_allowance);
    };
    plugged.run(milliseconds(8500));
    EXPECT_GE(plugged.least_books, -1e-9) << which;
    if (kind != TouchKind::bodies) {
      EXPECT_LE(above, 1e-9) << which;
    }
    longest = std::max(longest, TypeParam::lever(hand.place));
    least = std::min(least, plugged.least_own);
    allowance = std::max(allowance, plugged.last.encoder_allowance);
  }
  EXPECT_GT(felt, 1.0) << "nothing is felt";
  EXPECT_GT(longest, 1.2 * middle);
  std::printf(
      "least %.3g J without the encoders' allowance of up to %.3g J; to %.1f N; %.3g m/rad "
      "against %.3g in the middle\n",
      least, allowance, felt, longest, middle);
}

}  // namespace
}  // namespace reckon::haptics::usb_reach_test

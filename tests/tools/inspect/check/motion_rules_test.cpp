// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rules of `reckon inspect check` about orientation and frozen entities: a body that turns as it
// states is not reported, whatever its angles.
#include "reckon/tools/inspect/check/motion_rules.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/tools/support/checked_traffic.hpp"

namespace reckon::tools::motion_rules_test {
namespace {

using namespace checks;
using nlohmann::json;
using pdu::DeadReckoningAlgorithm;
using std::numbers::pi;
using ::testing::HasSubstr;

using Codes = std::map<std::string, int>;
const Codes kNone;
const Codes kOrientation{{"W-ORIENTATION", 1}};

/// Twenty updates of a resting body that turns, one each `step` [s].
struct Turning {
  DeadReckoningAlgorithm model = DeadReckoningAlgorithm::rvw;
  double step = 1;
  Eigen::Vector3d stated = Eigen::Vector3d::Zero();  // in body axes [rad/s]
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();    // true rate
  Eigen::Quaterniond begin = Eigen::Quaterniond::Identity();

  [[nodiscard]] Checked checked() const {
    CaptureBuilder capture;
    for (int i = 0; i < 20; ++i) {
      const double t = i * step;
      const auto time = nanoseconds(std::llround(1e9 * t));
      pdu::EntityState pdu = truck(time);
      pdu.location.y = 0;
      pdu.linear_velocity = {};
      pdu.dead_reckoning.algorithm = model;
      pdu.dead_reckoning.angular_velocity = {static_cast<float>(stated.x()),
                                             static_cast<float>(stated.y()),
                                             static_cast<float>(stated.z())};
      const auto angles =
          deadreckon::euler_from_quaternion(begin * deadreckon::exponential(rate * t));
      pdu.orientation = {static_cast<float>(angles.psi), static_cast<float>(angles.theta),
                         static_cast<float>(angles.phi)};
      capture.add(datagram_of(pdu), kStart + time);
    }
    return check(capture.path());
  }
};

TEST(MotionRules, AcceptABodyThatTurnsAsStated) {
  for (const auto model : {DeadReckoningAlgorithm::rpw, DeadReckoningAlgorithm::rvb}) {
    for (const double step : {0.1, 1.0, 4.0}) {
      for (const double speed : {0.5, -3.0, 7.3, 31.0}) {
        // Through +-pi about z, in loops through 90 degrees of pitch, and about an oblique axis.
        for (const Eigen::Vector3d& axis :
             {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.6, 0, 0.8)}) {
          const Eigen::Vector3d rate = speed * axis;
          EXPECT_EQ((Turning{model, step, rate, rate}.checked().codes()), kNone)
              << "DRM " << static_cast<int>(model) << ", " << speed << " rad/s each " << step;
        }
      }
    }
  }
}

TEST(MotionRules, AcceptTurnsOfModelsWithoutTurnRate) {
  // A roundabout at 60 degrees a second, and a pirouette.
  for (const double speed : {1.0, 2.1, 2.9})
    EXPECT_EQ((Turning{DeadReckoningAlgorithm::fpw, 1, {0, 0, 0}, {0, 0, speed}}.checked().codes()),
              kNone)
        << speed;
}

TEST(MotionRules, ReportATurnRateWithoutMatchingOrientation) {
  const Checked still = Turning{.stated = {0, 0, 20}}.checked();
  EXPECT_EQ(still.codes(), kOrientation);
  EXPECT_EQ(still.findings[0]["frame"], 4) << "three times in a row";
  EXPECT_EQ(still.findings[0]["at"], 116);
  EXPECT_EQ((Turning{.rate = {0, 0, 1.2}}.checked().codes()), kOrientation) << "it says 0";
  EXPECT_EQ((Turning{.stated = {0, 0, -1}, .rate = {0, 0, 1}}.checked().codes()), kOrientation);
  EXPECT_EQ((Turning{.stated = {0, 0, 28.6}, .rate = {0, 0, 0.5}}.checked().codes()), kOrientation)
      << "degrees a second";
}

TEST(MotionRules, ReportAHeadingThatFlips) {
  for (const auto model : {DeadReckoningAlgorithm::static_, DeadReckoningAlgorithm::fpw,
                           DeadReckoningAlgorithm::rvw}) {
    const Checked checked = Turning{.model = model, .rate = {0, 0, pi}}.checked();
    EXPECT_EQ(checked.codes(), kOrientation) << static_cast<int>(model);
    EXPECT_NEAR(checked.findings[0]["degrees"], 180, 0.01);
  }
}

TEST(MotionRules, ReportAnglesOutOfRangeOncePerEntity) {
  const auto findings_of = [](float psi, float theta, float phi) {
    CaptureBuilder capture;
    for (int i = 0; i < 3; ++i) {
      pdu::EntityState pdu = truck(seconds(i));
      pdu.orientation = {psi, theta, phi};
      capture.add(datagram_of(pdu), kStart + seconds(i));
    }
    return check(capture.path()).findings;
  };
  const auto half = static_cast<float>(pi);
  const auto quarter = static_cast<float>(pi / 2);
  EXPECT_TRUE(findings_of(half, quarter, -half).empty()) << "the ends of the ranges";
  const auto degrees = findings_of(0, 0, -90);
  ASSERT_EQ(degrees.size(), 1U);
  EXPECT_EQ(degrees[0]["rule"], "W-ORIENTATION");
  EXPECT_EQ(degrees[0]["at"], 80);
  EXPECT_EQ(degrees[0]["reason"], "entity_orientation.phi is -90 rad, beyond 3.14159: degrees?");
  EXPECT_THAT(findings_of(4, 0, 0)[0]["reason"].get<std::string>(), HasSubstr("or 0 to 2 pi?"));
  EXPECT_EQ(findings_of(0, 1.6F, 0)[0]["at"], 76);
}

TEST(MotionRules, LeaveFrozenEntitiesAlone) {
  const auto codes_of = [](DeadReckoningAlgorithm model, bool frozen) {
    CaptureBuilder capture;
    for (int i = 0; i < 6; ++i) {
      pdu::EntityState pdu = truck(seconds(i));
      pdu.location.y = 0;  // it rests, and keeps its former velocity
      pdu.dead_reckoning.algorithm = model;
      if (frozen) pdu.appearance = pdu::kAppearanceFrozen;
      capture.add(datagram_of(pdu), kStart + seconds(i));
    }
    return check(capture.path()).codes();
  };
  EXPECT_EQ(codes_of(DeadReckoningAlgorithm::fpw, true), kNone);
  EXPECT_EQ(codes_of(DeadReckoningAlgorithm::static_, true), kNone);
  EXPECT_EQ(codes_of(DeadReckoningAlgorithm::fpw, false)["W-VELOCITY"], 1);
}

}  // namespace
}  // namespace reckon::tools::motion_rules_test

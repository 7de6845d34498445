// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/sending/update_policy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"
#include "reckon/tests/support/declarations.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Vector3d;
using pdu::EntityDomain;
using pdu::EntityKind;
using test::Random;

constexpr double kHeartbeat = 5.0;

Pose still_at(const Vector3d& position) {
  Pose pose;
  pose.position = position;
  return pose;
}

UpdatePolicy policy_at_rest() {
  UpdatePolicy policy({1.0, 0.05, 0.1}, kHeartbeat);
  policy.sent(KinematicState{}, 0);
  return policy;
}

TEST(UpdatePolicy, SendsTheFirstState) {
  UpdatePolicy policy({}, kHeartbeat);
  EXPECT_EQ(policy.decide({}, 0), SendReason::first);
  policy.sent(KinematicState{}, 0);
  EXPECT_EQ(policy.decide({}, 0), SendReason::none);
}

TEST(UpdatePolicy, PositionThresholdIsASphereNotACube) {
  const UpdatePolicy policy = policy_at_rest();
  EXPECT_EQ(policy.decide(still_at({0.99, 0, 0}), 1), SendReason::none);
  EXPECT_EQ(policy.decide(still_at({1.01, 0, 0}), 1), SendReason::position);
  // Every axis is below 1 m, the distance is 1.04 m.
  EXPECT_EQ(policy.decide(still_at({0.6, 0.6, 0.6}), 1), SendReason::position);
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d direction = random.direction();
    EXPECT_EQ(policy.decide(still_at(0.999999 * direction), 1), SendReason::none);
    EXPECT_EQ(policy.decide(still_at(1.000001 * direction), 1), SendReason::position);
  }
}

TEST(UpdatePolicy, AngleThresholdIsTheAngleAboutAnyAxis) {
  const UpdatePolicy policy = policy_at_rest();
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d axis = random.direction();
    for (const double sign : {-1.0, 1.0}) {
      Pose truth;
      truth.orientation = exponential(0.0499999 * axis);
      truth.orientation.coeffs() *= sign;
      EXPECT_EQ(policy.decide(truth, 1), SendReason::none);
      truth.orientation = exponential(0.0500001 * axis);
      truth.orientation.coeffs() *= sign;
      EXPECT_EQ(policy.decide(truth, 1), SendReason::orientation);
    }
  }
}

// The error along this direction at which each rule sends.
double border(const SendRule& rule, const Thresholds& thresholds, const Eigen::Vector3d& direction,
              double speed = 0) {
  double low = 0, high = 100;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    UpdatePolicy policy(thresholds, 5, 5, rule);
    policy.sent({}, 0);
    Pose truth;
    truth.position = middle * direction.normalized();
    truth.velocity = {speed, 0, 0};
    (policy.decide(truth, 0) == SendReason::position ? high : low) = middle;
  }
  return high;
}

TEST(SendRules, ApplyTheirOwnErrorLimits) {
  Thresholds thresholds;
  thresholds.position = 0.5;
  thresholds.of<VelocityAware>().speed_allowance = 0.05;
  thresholds.of<SeenFrom>().viewer_distance = 4000;
  const auto rule = [](std::string_view name) -> const SendRule& {
    for (const SendRule& row : kSendRules)
      if (row.name == name) return row;
    throw std::runtime_error("no rule of this name");
  };
  const Eigen::Vector3d edge(1, 0, 0), corner(1, 1, 1);
  EXPECT_NEAR(border(rule("true_distance"), thresholds, corner), 0.5, 1e-8);
  EXPECT_NEAR(border(rule("per_axis"), thresholds, edge), 0.5, 1e-8);
  EXPECT_NEAR(border(rule("per_axis"), thresholds, corner), 0.5 * std::sqrt(3), 1e-8);
  EXPECT_NEAR(border(rule("velocity_aware"), thresholds, corner, 0), 0.5, 1e-8);
  EXPECT_NEAR(border(rule("velocity_aware"), thresholds, corner, 20), 1.5, 1e-8);
  EXPECT_NEAR(border(rule("seen_from"), thresholds, corner), 4000 / 60.0 * (std::numbers::pi / 180),
              1e-8);
  thresholds.of<SeenFrom>().viewer_distance = 1;  // nearby: the threshold itself
  EXPECT_NEAR(border(rule("seen_from"), thresholds, corner), 0.5, 1e-8);
}

TEST(SendRules, HaveARowForEveryDeclaredRule) {
  std::size_t rules = 0;
  for (const std::string& header : reckon::test::headers_in("deadreckon/sending")) {
    for (const std::string& rule :
         reckon::test::structs_with(reckon::test::source_text(header), "double share\\(")) {
      EXPECT_TRUE(
          reckon::test::is_row("deadreckon/sending/send_rules.hpp", "using SendRules", rule))
          << header << " declares " << rule << ": it needs a row in SendRules";
      ++rules;
    }
  }
  EXPECT_EQ(rules, kSendRules.size());
}

TEST(SendRules, StartFromTheDefaultsOfTheirTables) {
  const Thresholds thresholds;
  for_each_send_rule([&]<class Rule>(std::type_identity<Rule>) {
    for (const auto& row : Rule::kParameters) {
      EXPECT_EQ(thresholds.of<Rule>().*row.field, row.default_value) << row.key;
      EXPECT_LE(row.minimum, row.default_value) << row.key;
      EXPECT_LT(row.default_value, row.maximum) << row.key;
    }
  });
}

TEST(SendRules, SendForANonFinitePrediction) {
  KinematicState broken;
  broken.position.x() = std::numeric_limits<double>::quiet_NaN();
  for (const SendRule& rule : kSendRules) {
    UpdatePolicy policy({}, 5, 5, rule);
    policy.sent(broken, 0);
    EXPECT_EQ(policy.decide(Pose{}, 0), SendReason::position) << rule.name;
  }
}

TEST(UpdatePolicy, AllowsAShareOfALargeForce) {
  Thresholds thresholds;
  thresholds.force = 0.1;
  thresholds.weber = 0.1;
  UpdatePolicy policy(thresholds, 5);
  policy.sent({}, 0);
  EXPECT_EQ(policy.decide(Pose{}, 0, 0.4, 5), SendReason::none);
  EXPECT_EQ(policy.decide(Pose{}, 0, 0.6, 5), SendReason::force);
  EXPECT_EQ(policy.decide(Pose{}, 0, 0.11, 0.2), SendReason::force);
}

TEST(UpdatePolicy, HasTheDefaultsOfTheStandard) {
  const Thresholds thresholds;
  EXPECT_EQ(thresholds.position, 1.0);
  EXPECT_NEAR(thresholds.angle, 3.0 / 57.29577951308232, 1e-12);
}

TEST(UpdatePolicy, SendsAtTheHeartbeat) {
  const UpdatePolicy policy = policy_at_rest();
  EXPECT_EQ(policy.decide({}, 4.999), SendReason::none);
  EXPECT_EQ(policy.decide({}, 5.0), SendReason::heartbeat);
}

TEST(UpdatePolicy, SendsAnEventAtOnceAndOnce) {
  UpdatePolicy policy = policy_at_rest();
  policy.event();
  EXPECT_EQ(policy.decide({}, 0.001), SendReason::event);
  policy.sent(KinematicState{}, 0.001);
  EXPECT_EQ(policy.decide({}, 0.002), SendReason::none);
}

// Times [s] at which it repeats a state sent at 0 for this reason.
std::vector<double> said_again(SendReason reason, double first_heartbeat) {
  UpdatePolicy policy({}, 60.0, first_heartbeat, kDefaultSendRule, kEventRepeat);
  policy.sent({}, 0.0, reason);
  std::vector<double> times;
  for (int i = 1; i < 300; ++i) {
    if (policy.decide({}, 0.1 * i) != SendReason::heartbeat) continue;
    times.push_back(0.1 * i);
    policy.sent({}, 0.1 * i, SendReason::heartbeat);
  }
  return times;
}

TEST(UpdatePolicy, RepeatsAnEventSoonerButNotMoreOften) {
  using testing::DoubleNear, testing::ElementsAre;
  const auto near = [](double time) { return DoubleNear(time, 0.25); };
  EXPECT_THAT(said_again(SendReason::position, 1.0),
              ElementsAre(near(1), near(3), near(7), near(15)));
  EXPECT_THAT(said_again(SendReason::event, 1.0),
              ElementsAre(near(0.6), near(2.6), near(6.6), near(14.6)));
  EXPECT_THAT(said_again(SendReason::event, 10.0), ElementsAre(near(0.6), near(20.6)));
  EXPECT_THAT(
      said_again(SendReason::event, 0.2),
      ElementsAre(near(0.2), near(0.6), near(1.4), near(3), near(6.2), near(12.6), near(25.4)));
}

TEST(UpdatePolicy, SendsWhenTheForceErrorIsTooLarge) {
  const UpdatePolicy policy = policy_at_rest();
  EXPECT_EQ(policy.decide({}, 1, 0.0999), SendReason::none);
  EXPECT_EQ(policy.decide({}, 1, 0.1001), SendReason::force);
  EXPECT_EQ(policy.decide({}, 1, std::numeric_limits<double>::quiet_NaN()), SendReason::force);
}

TEST(UpdatePolicy, ComparesWithThePredictedPosition) {
  UpdatePolicy policy({1.0, 0.05, 0.1}, kHeartbeat);
  KinematicState s;
  s.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  s.velocity = {10, 0, 0};
  policy.sent(s, 100);
  EXPECT_EQ(policy.decide(still_at({30, 0, 0}), 103), SendReason::none);
  EXPECT_EQ(policy.decide(still_at({0, 0, 0}), 103), SendReason::position);
}

TEST(UpdatePolicy, NeverSendsANonFiniteTruth) {
  UpdatePolicy policy({}, kHeartbeat);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(policy.decide(still_at({nan, 0, 0}), 0), SendReason::none);
  Pose truth;
  truth.orientation.w() = nan;
  EXPECT_EQ(policy.decide(truth, 100), SendReason::none);
}

// The error at a peer for a freely moving entity never exceeds the thresholds by more than one
// tick.
TEST(UpdatePolicy, BoundsTheErrorOfPeersByTheThreshold) {
  constexpr double tick = 1e-3;
  UpdatePolicy policy({0.05, 0.02, 0.1}, kHeartbeat);
  Random random(3);
  KinematicState truth = random.state(pdu::DeadReckoningAlgorithm::rvw, 1);
  truth.position.setZero();
  truth.velocity.setZero();
  int sent = 0;
  double worst = 0, worst_angle = 0;
  for (int i = 0; i < 60000; ++i) {
    const double now = i * tick;
    if (i % 300 == 0) truth.acceleration = random.vector(3) - truth.velocity - truth.position;
    if (i % 500 == 0) truth.angular_velocity = random.vector(1);
    const Pose actual = extrapolate(truth, 0);
    if (policy.decide(actual, now) != SendReason::none) {
      policy.sent(truth, now);
      ++sent;
    }
    const Pose seen = policy.predicted(now);
    worst = std::max(worst, (seen.position - actual.position).norm());
    worst_angle = std::max(worst_angle, angle_between(seen.orientation, actual.orientation));
    const Pose next = extrapolate(truth, tick);
    truth.position = next.position;
    truth.velocity = next.velocity;
    truth.orientation = next.orientation.normalized();
  }
  std::printf("%d updates a minute, worst %.4f m, %.4f rad\n", sent, worst, worst_angle);
  EXPECT_LE(worst, 0.05);
  EXPECT_LE(worst_angle, 0.02);
  EXPECT_LT(sent, 6000);
}

TEST(Heartbeat, FollowsKindAndDomain) {
  const auto of = [](EntityKind kind, EntityDomain domain) {
    pdu::EntityType type;
    type.kind = kind;
    type.domain = domain;
    return nominal_heartbeat(type);
  };
  EXPECT_EQ(of(EntityKind::platform, EntityDomain::air), 5);
  EXPECT_EQ(of(EntityKind::platform, EntityDomain::space), 5);
  EXPECT_EQ(of(EntityKind::platform, EntityDomain::land), 55);
  EXPECT_EQ(of(EntityKind::platform, EntityDomain::surface), 55);
  EXPECT_EQ(of(EntityKind::platform, EntityDomain::subsurface), 55);
  EXPECT_EQ(of(EntityKind::munition, EntityDomain::land), 5);
  EXPECT_EQ(of(EntityKind::supply, EntityDomain::land), 5);
  EXPECT_EQ(of(EntityKind::radio, EntityDomain::land), 5);
  EXPECT_EQ(of(EntityKind::life_form, EntityDomain::land), 60);
  EXPECT_EQ(of(EntityKind::environmental, EntityDomain::air), 60);
  EXPECT_EQ(of(EntityKind::cultural_feature, EntityDomain::land), 60);
  EXPECT_EQ(nominal_heartbeat(pdu::EntityType{}, true), 60);
  EXPECT_EQ(kHapticHeartbeat, 5);
}

TEST(Heartbeat, IsSpreadByTenPercentPerEntity) {
  std::set<double> periods;
  double sum = 0;
  constexpr int kCount = 4000;
  for (int i = 0; i < kCount; ++i) {
    const pdu::EntityId id{static_cast<std::uint16_t>(i % 7), 3, static_cast<std::uint16_t>(i)};
    const double period = jittered_heartbeat(5.0, id);
    EXPECT_GE(period, 4.5);
    EXPECT_LE(period, 5.5);
    EXPECT_EQ(period, jittered_heartbeat(5.0, id));
    periods.insert(period);
    sum += period;
  }
  EXPECT_GT(periods.size(), 2000u);
  EXPECT_NEAR(sum / kCount, 5.0, 0.03);
}

TEST(Heartbeat, OfManyEntitiesShareFewMoments) {
  constexpr double kNominal = 60.0;
  const HeartbeatGrid grid = heartbeat_grid(kNominal, {7, 3});
  EXPECT_DOUBLE_EQ(grid.step, 6.0);
  std::set<long> moments;
  for (std::uint16_t number = 1; number <= 200; ++number) {
    const double heartbeat = jittered_heartbeat(kNominal, {7, 3, number});
    UpdatePolicy policy({}, heartbeat, 1.0);
    policy.align_heartbeats(grid.step, grid.phase);
    double sent = 0.3 * number;  // they start one after another
    policy.sent({}, sent, SendReason::event);
    for (int i = 0; i < 12; ++i) {
      const double due = sent + policy.silence();
      EXPECT_EQ(policy.decide({}, due - 1e-3), SendReason::none);
      ASSERT_EQ(policy.decide({}, due + 1e-9), SendReason::heartbeat);
      if (i > 7) {  // the doubling repetitions are over
        EXPECT_GE(due - sent, heartbeat - grid.step - 1e-5);
        EXPECT_LE(due - sent, heartbeat + 1e-5);
        const double beats = (due - grid.phase) / grid.step;
        EXPECT_NEAR(beats, std::round(beats), 1e-5);
        if (due > 500 && due < 560) moments.insert(std::lround(beats));
      }
      sent = due;
      policy.sent({}, sent, SendReason::heartbeat);
    }
  }
  EXPECT_LE(moments.size(), 11U);
}

TEST(Heartbeat, OfTwoPeersAreAtDifferentMoments) {
  std::set<double> phases;
  for (std::uint16_t application = 1; application <= 50; ++application) {
    const HeartbeatGrid grid = heartbeat_grid(60.0, {7, application});
    EXPECT_GE(grid.phase, 0.0);
    EXPECT_LE(grid.phase, grid.step);
    phases.insert(grid.phase);
  }
  EXPECT_GT(phases.size(), 45U);
}

TEST(Heartbeat, TimesOutAfterTwoPointFourPeriods) {
  EXPECT_DOUBLE_EQ(timeout(5.0), 12.0);
  EXPECT_DOUBLE_EQ(timeout(55.0), 132.0);
  EXPECT_GT(timeout(5.0), 2 * 5.0 * 1.1);
}

TEST(UpdatePolicy, NamesEveryReason) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(SendReason::heartbeat); ++i) {
    names.insert(name(static_cast<SendReason>(i)));
  }
  EXPECT_EQ(names.size(), 7u);
  EXPECT_EQ(name(static_cast<SendReason>(200)), "unknown");
}

}  // namespace
}  // namespace reckon::deadreckon

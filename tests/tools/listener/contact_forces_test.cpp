// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Forces from PDUs, compared with closed forms: k1 d + k3 d^3 along the line between two balls.
#include "reckon/tools/listener/contact_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "reckon/pdu/bundle.hpp"
#include "reckon/tests/tools/support/haptic_traffic.hpp"

namespace reckon::tools::contact_forces_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::Ball;
using test::Octets;

constexpr nanoseconds kStart = seconds(1'700'000'000);
/// Locations of 6.4e6 m are doubles with 1 nm resolution, times 500 N/m; radius and stiffness are
/// float32.
constexpr double kTolerance = 3e-6;  // [N]

/// A listener as in a peer, and its current forces.
struct ForceListener {
  Listener listener{kPeerRules};
  ContactForces forces;

  [[nodiscard]] std::span<const ContactForce> at(nanoseconds time) {
    listener.forget_silent(time);
    return forces.forces_at(listener, time);
  }
};

void feed(ForceListener& received, const Octets& datagram, nanoseconds time) {
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram))
    received.listener.take_pdu(pdu.bytes, pdu.header, time);
}

std::vector<ForceJump> end_datagram(ForceListener& received, nanoseconds time) {
  const auto jumps = received.forces.jumps_of_datagram(received.listener, time);
  received.listener.end_datagram();
  return {jumps.begin(), jumps.end()};
}

/// Feeds a datagram of its own and returns the jumps.
std::vector<ForceJump> update(ForceListener& received, const Ball& ball) {
  feed(received, test::datagram_of(ball), ball.time);
  return end_datagram(received, ball.time);
}

std::optional<ContactForce> force(ForceListener& received, std::uint16_t on, std::uint16_t by,
                                  nanoseconds time) {
  for (const ContactForce& found : received.at(time))
    if (found.on.entity == on && found.by.entity == by) return found;
  return std::nullopt;
}

TEST(ContactForces, OfTwoBallsEqualTheirSprings) {
  ForceListener received;
  (void)update(received, {.entity = 1, .time = kStart});
  (void)update(received, {.entity = 2, .up = 0.015, .k1 = 800, .k3 = 0, .time = kStart});
  const double depth = 0.02 - 0.015;
  const auto on_2 = force(received, 2, 1, kStart);
  const auto on_1 = force(received, 1, 2, kStart);
  ASSERT_TRUE(on_2.has_value() && on_1.has_value());
  EXPECT_NEAR(on_2->depth, depth, 2e-9);
  const Eigen::Vector3d up = (500 * depth + 1e6 * depth * depth * depth) * Eigen::Vector3d::UnitZ();
  EXPECT_LT((on_2->force - up).norm(), kTolerance);
  EXPECT_LT((on_1->force + 800 * depth * Eigen::Vector3d::UnitZ()).norm(), kTolerance);
  EXPECT_LT((ContactForces::force_on(received.listener, {1, 2, 2}, kStart) - up).norm(),
            kTolerance);
  EXPECT_EQ(received.at(kStart).size(), 2U);
}

TEST(ContactForces, PointEastNorthAndUp) {
  ForceListener received;
  (void)update(received, {.entity = 1, .time = kStart});
  (void)update(received, {.entity = 2, .east = 0.009, .north = 0.012, .k3 = 0, .time = kStart});
  const auto found = force(received, 2, 1, kStart);
  ASSERT_TRUE(found.has_value());
  const double newtons = 500 * 0.005 + 1e6 * std::pow(0.005, 3);
  EXPECT_LT((found->force - newtons * Eigen::Vector3d(0.6, 0.8, 0)).norm(), kTolerance);
}

TEST(ContactForces, FollowThePredictionBetweenUpdates) {
  ForceListener received;
  (void)update(received, {.entity = 1, .k3 = 0, .time = kStart});
  (void)update(received, {.entity = 2, .up = 0.03, .rising = -0.1, .k3 = 0, .time = kStart});
  EXPECT_FALSE(force(received, 2, 1, kStart + milliseconds(99)).has_value());
  for (const int ms : {110, 150, 200}) {
    const auto found = force(received, 2, 1, kStart + milliseconds(ms));
    ASSERT_TRUE(found.has_value()) << ms;
    // The timestamp is rounded to its unit of 1.7 us, in which the ball moves 0.17 um.
    EXPECT_NEAR(found->force.norm(), 500 * (0.1 * 1e-3 * ms - 0.01), 5e-5) << ms;
  }
}

TEST(ContactForces, AreAtTheModelsPointInBodyAxes) {
  // A yaw of 90 degrees about geocentric z turns body x to east, so the centre is 6 mm east.
  ForceListener received;
  Octets datagram;
  pdu::EntityState state = test::state_of({.entity = 1, .time = kStart});
  state.orientation = {static_cast<float>(std::numbers::pi / 2), 0, 0};
  pdu::HapticRecord record = test::record_of({.k3 = 0});
  record.point = {0.006F, 0, 0};
  test::append_pdu(datagram, state);
  test::append_attribute(datagram, state, record);
  feed(received, datagram, kStart);
  (void)end_datagram(received, kStart);
  (void)update(received, {.entity = 2, .east = 0.021, .k3 = 0, .time = kStart});
  const auto found = force(received, 2, 1, kStart);
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((found->force - 2.5 * Eigen::Vector3d::UnitX()).norm(), kTolerance);
}

TEST(ContactForces, ReportTheirChangeByAnUpdate) {
  ForceListener received;
  (void)update(received, {.entity = 1, .k3 = 0, .time = kStart});
  (void)update(received, {.entity = 2, .up = 0.015, .k3 = 0, .time = kStart});
  const auto jumps =
      update(received, {.entity = 2, .up = 0.013, .k3 = 0, .time = kStart + milliseconds(10)});
  ASSERT_EQ(jumps.size(), 2U);  // on 2 by 1, and on 1 by 2
  for (const ForceJump& jump : jumps) EXPECT_NEAR(jump.size, 500 * 0.002, kTolerance);
  // A change of the model without motion counts as well.
  const auto stiffer =
      update(received, {.entity = 1, .k1 = 600, .k3 = 0, .time = kStart + milliseconds(20)});
  ASSERT_EQ(stiffer.size(), 2U);
  EXPECT_NEAR(std::max(stiffer[0].size, stiffer[1].size), 100 * 0.007, kTolerance);
}

TEST(ContactForces, EndWithTheModelsValidityAndTheEntity) {
  ForceListener received;
  (void)update(received, {.entity = 1, .time = kStart});
  (void)update(received, {.entity = 2, .up = 0.015, .time = kStart + milliseconds(500)});
  EXPECT_TRUE(force(received, 2, 1, kStart + seconds(1)).has_value());
  EXPECT_FALSE(force(received, 2, 1, kStart + milliseconds(1001)).has_value());
  EXPECT_TRUE(force(received, 1, 2, kStart + milliseconds(1001)).has_value());
  EXPECT_EQ(received.listener.entities().size(), 2U);
  (void)received.at(kStart +
                    milliseconds(12400));  // 2.4 heartbeats of 5 s after the first fell silent
  EXPECT_EQ(received.listener.entities().size(), 1U);

  Octets leaving;
  pdu::EntityState state = test::state_of({.entity = 2, .time = kStart + seconds(12)});
  state.appearance = pdu::kAppearanceDeactivated;
  test::append_pdu(leaving, state);
  feed(received, leaving, kStart + seconds(12));
  EXPECT_TRUE(end_datagram(received, kStart + seconds(12)).empty());
  EXPECT_TRUE(received.listener.entities().empty());
}

TEST(ContactForces, RefuseTheSameAsAPeer) {
  ForceListener received;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  (void)update(received, {.entity = 1, .up = kNan, .time = kStart});
  EXPECT_TRUE(received.listener.entities().empty());
  EXPECT_EQ(received.listener.refusals().values, 1U);  // its model is not read
  (void)update(received, {.entity = 1, .k1 = -5, .time = kStart});
  EXPECT_EQ(received.listener.refusals().values, 2U);
  EXPECT_FALSE(received.listener.find_entity({1, 2, 1})->is_haptic());

  (void)update(received, {.entity = 1, .time = kStart + seconds(1)});
  const auto late = update(received, {.entity = 1, .up = 5, .time = kStart});
  EXPECT_EQ(received.listener.refusals().stale, 1U);
  EXPECT_TRUE(late.empty());

  Octets alone;
  test::append_attribute(alone, test::state_of({.entity = 9}), test::record_of({}));
  feed(received, alone, kStart);
  EXPECT_EQ(received.listener.refusals().unplaced, 1U);
}

TEST(ContactForces, OfAnUncoupledEntityAreNotLookedAt) {
  ForceListener received;
  Octets datagram;
  pdu::EntityState state = test::state_of({.entity = 1, .time = kStart});
  state.header.pdu_status = 0;
  test::append_pdu(datagram, state);
  feed(received, datagram, kStart);
  EXPECT_TRUE(received.listener.entities().empty());
}

TEST(ContactForces, StoreTheStatedEnergyOfEachEntity) {
  ForceListener received;
  pdu::EnergyAccountRecord account;
  account.counterpart = {1, 2, 2};
  account.given = 0.25;
  account.need = 500;
  (void)update(received, {.entity = 1, .time = kStart, .account = account});
  EXPECT_EQ(received.listener.stated_energy({1, 2, 1}, {1, 2, 2}).given, 0.25);
  EXPECT_EQ(received.listener.stated_energy({1, 2, 1}).need, 5e-4);
  EXPECT_EQ(received.listener.stated_energy({1, 2, 2}, {1, 2, 1}).given, 0.0);
  account.given = std::numeric_limits<double>::infinity();
  (void)update(received, {.entity = 1, .time = kStart + seconds(1), .account = account});
  EXPECT_EQ(received.listener.stated_energy({1, 2, 1}).given, 0.25);
}

TEST(ContactForces, BeyondTheCapacityAreCounted) {
  ForceListener received;
  for (std::uint16_t i = 1; i <= 600; ++i)
    (void)update(received, {.entity = i, .up = 1.0 * i, .time = kStart});
  EXPECT_EQ(received.listener.entities().size(), kPeerRules.most_entities);
  EXPECT_EQ(received.listener.refusals().crowded, 600U - kPeerRules.most_entities);
  EXPECT_TRUE(received.at(kStart).empty());
}

TEST(ContactForces, PlanesActOnBallsOnly) {
  ForceListener received;
  Octets datagram;
  const pdu::EntityState state = test::state_of({.entity = 1, .time = kStart});
  pdu::HapticRecord record = test::record_of({.k3 = 0});
  record.kind = pdu::ForceModelKind::plane;
  record.normal = {1, 0, 0};  // up
  test::append_pdu(datagram, state);
  test::append_attribute(datagram, state, record);
  feed(received, datagram, kStart);
  (void)end_datagram(received, kStart);
  (void)update(received, {.entity = 2, .up = 0.004, .east = 3, .time = kStart});
  ASSERT_EQ(received.at(kStart).size(), 1U);
  EXPECT_NEAR(force(received, 2, 1, kStart)->force.z(), 500 * 0.006, kTolerance);
}

}  // namespace
}  // namespace reckon::tools::contact_forces_test

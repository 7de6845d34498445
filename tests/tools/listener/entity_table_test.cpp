// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The table of a listener: jumps by closed forms, causes, rates, silence, bounds.
#include "reckon/tools/listener/entity_table.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "reckon/pdu/management/entity_request.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/haptic_traffic.hpp"
#include "reckon/tools/listener/contact_forces.hpp"

namespace reckon::tools::entity_table_test {
namespace {

using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::append_pdu;
using test::Octets;

constexpr nanoseconds kStart = seconds(1'700'000'000);
constexpr double kRadius = 6'378'137.0;

nanoseconds after(double time) { return kStart + nanoseconds(std::llround(1e9 * time)); }

/// Passes datagrams to a table as the verb does.
class Ear {
 public:
  explicit Ear(std::size_t most_rows = EntityTable::kMostRows) : table(most_rows) {}

  void hear(const Octets& octets, double time) {
    peer::SourceDatagram datagram;
    datagram.frame = ++frame_;
    datagram.time = after(time);
    datagram.bytes = octets;
    (void)inspector_.inspect(datagram, [&](const PduRow& row) {
      table.take_pdu(row, datagram);
      return true;
    });
  }
  template <pdu::Pdu... T>
  void hear(double time, const T&... pdu) {
    Octets octets;
    (append_pdu(octets, pdu), ...);
    hear(octets, time);
  }
  [[nodiscard]] const EntityRow& row(std::size_t place = 0) const { return table.rows()[place]; }
  [[nodiscard]] const ReceivedEntity& entity(std::size_t place = 0) const {
    return table.entities()[place];
  }

  EntityTable table;

 private:
  DatagramInspector inspector_;
  std::uint64_t frame_ = 0;
};

/// An aircraft on the equator, moving north (z), with a timestamp of `time`.
pdu::EntityState aircraft(double time, double z, double velocity = 0, std::uint16_t entity = 1) {
  pdu::EntityState pdu;
  pdu.header.timestamp = pdu::to_dis_timestamp(after(time), true);
  pdu.entity_id = {1, 2, entity};
  pdu.entity_type.kind = pdu::EntityKind::platform;
  pdu.entity_type.domain = pdu::EntityDomain::air;
  pdu.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  pdu.location = {kRadius, 0, z};
  pdu.linear_velocity = {0, 0, static_cast<float>(velocity)};
  return pdu;
}

TEST(EntityTable, MeasuresJumpsFromTheExtrapolation) {
  Ear ear;
  ear.hear(0, aircraft(0, 0, 100));
  ear.hear(2, aircraft(2, 200.75, 100));  // 200 m were predicted
  EXPECT_NEAR(ear.row().jump, 0.75, 1e-3);
  EXPECT_EQ(ear.row().cause, UpdateCause::threshold);
  EXPECT_EQ(ear.row().jumps.count(), 1U);
}

TEST(EntityTable, MeasuresJumpsOfTurnsInBodyAxes) {
  // A circle of radius v/w, dead-reckoned as straight flight (FPB): the closed form below gives its
  // error.
  const double v = 50;
  const double w = 0.1;
  const double t = 3;
  pdu::EntityState first = aircraft(0, 0);
  first.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpb;
  first.linear_velocity = {static_cast<float>(v), 0, 0};
  first.orientation = {0.4F, 0, 0};
  pdu::EntityState second = first;
  second.header.timestamp = pdu::to_dis_timestamp(after(t), true);
  const double psi = double{first.orientation.psi};
  second.location.x += v / w * (std::sin(psi + w * t) - std::sin(psi));
  second.location.y -= v / w * (std::cos(psi + w * t) - std::cos(psi));
  second.orientation.psi = static_cast<float>(psi + w * t);
  Ear ear;
  ear.hear(0, first);
  ear.hear(t, second);
  const double chord_x = v / w * std::sin(w * t) - v * t;
  const double chord_y = v / w * (1 - std::cos(w * t));
  EXPECT_NEAR(ear.row().jump, std::hypot(chord_x, chord_y), 1e-3);
  EXPECT_NEAR(ear.row().turn, 17.1887, 1e-3) << "0.3 rad, which FPB does not foretell";
  EXPECT_EQ(ear.row().turns.count(), 1U);

  // The model with rotation predicts it exactly.
  Ear turning;
  for (pdu::EntityState* pdu : {&first, &second}) {
    pdu->dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rpb;
    pdu->dead_reckoning.angular_velocity = {0, 0, static_cast<float>(w)};
  }
  turning.hear(0, first);
  turning.hear(t, second);
  EXPECT_LT(turning.row().jump, 1e-3);
  EXPECT_LT(turning.row().turn, 1e-3);
  EXPECT_EQ(turning.row().cause, UpdateCause::repeat);
}

TEST(EntityTable, TakesTimestampsAndNotTheJitterOfArrivals) {
  Ear ear;
  for (int i = 0; i < 50; ++i) {
    const double time = 0.1 * i;
    ear.hear(time + (i % 3) * 0.03, aircraft(time, 300 * time, 300));
  }
  EXPECT_LT(ear.row().jumps.max(), 2e-3);  // 300 m/s times a timestamp's unit
  EXPECT_EQ(ear.row().causes[static_cast<std::size_t>(UpdateCause::threshold)], 0U);
}

TEST(EntityTable, TakesArrivalsWhereTimestampsStandStillOrCreep) {
  for (const double pace : {0.0, 1e-6}) {
    Ear ear;
    for (int i = 0; i < 20; ++i) ear.hear(i, aircraft(pace * i, 10.0 * i, 10));
    EXPECT_LT(ear.row().jumps.percentile(0.99), 1e-3) << pace;
    EXPECT_EQ(ear.entity().updates, 20U);
  }
}

TEST(EntityTable, TakesTimestampsOfAReplayThatRunsFaster) {
  Ear ear;
  for (int i = 0; i < 20; ++i) ear.hear(0.05 * i, aircraft(i, 10.0 * i, 10));
  EXPECT_LT(ear.row().jumps.max(), 1e-3);
}

TEST(EntityTable, CountsNoJumpForDuplicateOrLateUpdates) {
  Ear ear;
  ear.hear(0.0, aircraft(0, 0, 10));
  ear.hear(1.0, aircraft(1, 10, 10));
  ear.hear(1.001, aircraft(1, 10, 10));  // twice
  ear.hear(3.0, aircraft(3, 30, 10));
  ear.hear(3.001, aircraft(2, 20, 10));  // overtaken
  ear.hear(4.0, aircraft(4, 40, 10));
  const EntityRow& row = ear.row();
  EXPECT_EQ(ear.entity().updates, 4U);
  EXPECT_EQ(row.duplicated, 1U);
  EXPECT_EQ(row.late, 1U);
  EXPECT_EQ(row.jumps.count(), 3U);
  EXPECT_LT(row.jumps.max(), 1e-3);
}

TEST(EntityTable, RestartsWhenASendersClockWasSetBack) {
  Ear ear;
  ear.hear(0, aircraft(100, 0, 10));
  for (int i = 1; i < 8; ++i) ear.hear(i, aircraft(95 + i, 10.0 * i, 10));
  const EntityRow& row = ear.row();
  EXPECT_EQ(row.late, 3U);
  EXPECT_EQ(ear.entity().updates, 5U);
  EXPECT_LT(row.jumps.max(), 1e-3);
  EXPECT_EQ(row.causes[static_cast<std::size_t>(UpdateCause::first)], 2U);
}

TEST(EntityTable, DeterminesTheCauseOfAnUpdate) {
  Ear ear;
  std::vector<UpdateCause> causes;
  const auto hear = [&](const pdu::EntityState& pdu, double time) {
    ear.hear(time, pdu);
    causes.push_back(ear.row().cause);
  };
  hear(aircraft(0, 0), 0);      // first
  hear(aircraft(5, 0), 5);      // no change after 5 s
  hear(aircraft(6, 0), 6);      // no change, early
  hear(aircraft(7, 2), 7);      // moved
  hear(aircraft(12, 2.5), 12);  // moved by less than the threshold
  hear(aircraft(17, 5), 17);    // moved by more
  pdu::EntityState burning = aircraft(18, 5);
  burning.appearance = 1U << 15;
  hear(burning, 18);
  burning.header.timestamp = pdu::to_dis_timestamp(after(19), true);
  burning.orientation.psi = 0.1F;  // turned
  hear(burning, 19);
  EXPECT_THAT(causes, testing::ElementsAre(UpdateCause::first, UpdateCause::heartbeat,
                                           UpdateCause::repeat, UpdateCause::threshold,
                                           UpdateCause::heartbeat, UpdateCause::threshold,
                                           UpdateCause::event, UpdateCause::threshold));
}

TEST(EntityTable, TakesTheRateOverAWindowThatSlides) {
  Ear ear;
  double time = 0;
  for (; time < 20; time += 0.1) ear.hear(time, aircraft(time, 0));
  EXPECT_NEAR(ear.row().rate(ear.entity(), after(20)), 10, 0.2);
  for (; time < 40; time += 1) ear.hear(time, aircraft(time, 0));
  EXPECT_NEAR(ear.row().rate(ear.entity(), after(40)), 1, 0.1);
  EXPECT_LT(ear.row().rate(ear.entity(), after(60)), 0.5) << "nothing came since";
  EXPECT_EQ(ear.row().rate(ear.entity(), after(200)), 0) << "stale";
}

TEST(EntityTable, KeepsADepartedEntitysRateForASecond) {
  Ear ear;
  for (double time = 0; time < 5; time += 0.1) ear.hear(time, aircraft(time, 0));
  pdu::EntityState last = aircraft(5, 0);
  last.appearance |= pdu::kAppearanceDeactivated;
  ear.hear(5, last);
  EXPECT_NEAR(ear.row().rate(ear.entity(), after(5.5)), 10, 1.5);
  EXPECT_EQ(ear.row().rate(ear.entity(), after(6.1)), 0);
}

TEST(EntityTable, IsStaleAfterItsTimeOut) {
  Ear ear;
  ear.hear(0, aircraft(0, 0, 10));
  pdu::EntityState tank = aircraft(0, 0, 10, 2);
  tank.entity_type.domain = pdu::EntityDomain::land;
  ear.hear(0, tank);
  EXPECT_FALSE(ear.entity(0).is_silent(after(12.0)));
  EXPECT_TRUE(ear.entity(0).is_silent(after(12.001)));
  EXPECT_FALSE(ear.entity(1).is_silent(after(132.0)));
  EXPECT_TRUE(ear.entity(1).is_silent(after(132.001)));
}

TEST(EntityTable, CountsNoJumpAfterTheTimeOut) {
  Ear ear;
  ear.hear(0, aircraft(0, 0, 10));
  ear.hear(30, aircraft(30, 5000, 10));
  EXPECT_EQ(ear.row().jumps.count(), 0U);
  EXPECT_EQ(ear.row().cause, UpdateCause::first);
}

TEST(EntityTable, ShowsDepartedEntitiesForAWhile) {
  Ear ear;
  for (std::uint16_t i = 1; i <= 3; ++i) ear.hear(0, aircraft(0, 0, 0, i));
  pdu::EntityState leaving = aircraft(1, 0, 0, 1);
  leaving.appearance = pdu::kAppearanceDeactivated;
  pdu::RemoveEntity remove;
  remove.receiving_entity_id = {1, 2, 2};
  ear.hear(1, leaving, remove);
  EXPECT_TRUE(ear.entity(0).gone);
  EXPECT_TRUE(ear.entity(1).gone);
  EXPECT_FALSE(ear.entity(2).gone);
  ear.table.drop_gone(after(10.9));
  EXPECT_EQ(ear.table.rows().size(), 3U);
  ear.table.drop_gone(after(11.1));
  ASSERT_EQ(ear.table.rows().size(), 1U);
  EXPECT_EQ(ear.entity().id.entity, 3);
  ear.hear(12, aircraft(12, 0, 0, 3), aircraft(12, 0, 0, 1));
  EXPECT_EQ(ear.table.rows().size(), 2U);
  EXPECT_EQ(ear.entity(0).updates, 2U);
  EXPECT_EQ(ear.row(1).cause, UpdateCause::first);
}

TEST(EntityTable, CountsEntitiesBeyondItsCapacity) {
  Ear ear(2);
  for (std::uint16_t i = 1; i <= 5; ++i) ear.hear(0, aircraft(0, 0, 0, i));
  ear.hear(1, aircraft(1, 0, 0, 2));
  EXPECT_EQ(ear.table.rows().size(), 2U);
  EXPECT_EQ(ear.table.others(), 3U);
  EXPECT_EQ(ear.entity(1).updates, 2U);
}

TEST(EntityTable, FindsEveryOneOfManyEntities) {
  Ear ear;
  for (std::uint16_t i = 1; i <= 5000; ++i) ear.hear(0, aircraft(0, 0, 0, i));
  for (std::uint16_t i = 1; i <= 5000; ++i) ear.hear(1, aircraft(1, 0, 0, i));
  ASSERT_EQ(ear.table.rows().size(), 5000U);
  for (const ReceivedEntity& entity : ear.table.entities()) EXPECT_EQ(entity.updates, 2U);
}

/// By the rules of a peer, as the view `haptics` requests the forces of each pair.
TEST(EntityTable, FindsTheForcesThatTheViewHapticsFinds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-0.006, 0.006);
  Ear ear;
  Listener listener(kPeerRules);
  ContactForces forces;
  double largest = 0;
  std::map<std::uint16_t, double> jumps;
  for (int step = 0; step < 300; ++step) {
    const double time = 0.03 * step;
    test::Ball ball;
    ball.entity = static_cast<std::uint16_t>(1 + step % 3);
    ball.up = place(random);
    ball.east = place(random) + 0.012 * (step % 3);
    ball.north = place(random);
    ball.rising = 10 * place(random);
    ball.time = after(time);
    const Octets octets = test::datagram_of(ball);
    ear.hear(octets, time);
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(octets))
      listener.take_pdu(bundled.bytes, bundled.header, after(time));
    for (const ForceJump& jump : forces.jumps_of_datagram(listener, after(time)))
      if (jump.by.entity == ball.entity)
        jumps[ball.entity] = std::max(jumps[ball.entity], jump.size);
    listener.end_datagram();
    for (const ReceivedEntity& entity : ear.table.entities()) {
      double expected = 0;
      for (const ContactForce& force : forces.forces_at(listener, after(time)))
        if (force.by == entity.id) expected = std::max(expected, force.force.norm());
      EXPECT_NEAR(ear.table.contact_force(entity, after(time)), expected, 2e-3) << step;
      largest = std::max(largest, expected);
    }
  }
  EXPECT_GT(largest, 5);
  for (const ReceivedEntity& entity : ear.table.entities()) {
    const JumpHistogram* found = ear.table.force_jumps(entity);
    ASSERT_NE(found, nullptr);
    EXPECT_NEAR(found->max(), jumps[entity.id.entity], 2e-3);
    EXPECT_GT(jumps[entity.id.entity], 1);
  }
}

TEST(EntityTable, AllocatesNothingForEntitiesThatItKnows) {
  EntityTable table;
  DatagramInspector inspector;
  Octets octets;
  append_pdu(octets, aircraft(0, 0));
  const auto hear = [&](int step) {
    const pdu::EntityState pdu = aircraft(step, 10.0 * (step % 7), 10);
    (void)encode(pdu, octets);
    peer::SourceDatagram datagram;
    datagram.time = after(step);
    datagram.bytes = octets;
    (void)inspector.inspect(datagram, [&](const PduRow& row) {
      table.take_pdu(row, datagram);
      return true;
    });
  };
  for (int step = 0; step < 3; ++step) hear(step);
  const test::AllocationGuard guard;
  for (int step = 3; step < 1000; ++step) hear(step);
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(table.entities()[0].updates, 1000U);
}

TEST(EntityTable, NamesTheRuleOfTheLastBadPdu) {
  Ear ear;
  ear.hear(0, aircraft(0, 0));
  Octets cut;
  append_pdu(cut, aircraft(1, 0));
  cut.resize(100);
  ear.hear(cut, 1);
  EXPECT_EQ(ear.row().bad, 1U);
  EXPECT_TRUE(ear.row().last_is_bad);
  EXPECT_EQ(ear.row().rule, "E-TRUNCATED");
  pdu::EntityState nowhere = aircraft(2, 0);
  nowhere.location.x = std::nan("");
  ear.hear(2, nowhere);
  EXPECT_EQ(ear.row().bad, 2U);
  EXPECT_EQ(ear.row().rule, "W-NOT-FINITE");
  EXPECT_EQ(ear.entity().updates, 1U);
  ear.hear(3, aircraft(3, 0));
  EXPECT_FALSE(ear.row().last_is_bad);
  EXPECT_EQ(ear.row().bad, 2U);
}

}  // namespace
}  // namespace reckon::tools::entity_table_test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/history/history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/tools/support/driven_trucks.hpp"

namespace reckon::tools::history_test {
namespace {

using trucks::datagram_of;
using trucks::kStart;
using trucks::milliseconds;
using trucks::nanoseconds;
using trucks::seconds;
using trucks::Sent;

constexpr double kMillimetre = 1e-3;

const deadreckon::LocalFrame& frame() {
  static const deadreckon::LocalFrame kFrame(0, 0, 0);
  return kFrame;
}

HistoryOptions whole() {
  HistoryOptions options;
  options.span.reset();
  return options;
}

void take(History& history, const std::vector<Sent>& all) {
  for (const Sent& sent : all) ASSERT_TRUE(history.take(datagram_of(sent)));
}

/// The positions in the inspector's table at an instant, from the datagrams until then; by
/// marking's slot.
std::vector<Eigen::Vector3d> shown_by_table(const std::vector<Sent>& all, nanoseconds time) {
  EntityTable table(64);
  DatagramInspector inspector;
  for (const Sent& sent : all) {
    if (sent.time > time) break;
    const auto datagram = datagram_of(sent);
    (void)inspector.inspect(datagram, [&](const PduRow& row) {
      table.take_pdu(row, datagram);
      return true;
    });
  }
  std::vector<Eigen::Vector3d> places;
  for (const ReceivedEntity& entity : table.entities())
    places.push_back(frame().scene_from_world(entity.pose_at(time).position));
  return places;
}

std::vector<EntityMark> marks_of(const ReceivedWorld& world, const History& history,
                                 nanoseconds time) {
  std::vector<EntityMark> marks;
  world.add_marks(time, history.start(), history.roster(), frame(), marks);
  return marks;
}

void expect_same(const std::vector<EntityMark>& marks, const std::vector<Eigen::Vector3d>& places) {
  ASSERT_EQ(marks.size(), places.size());
  for (std::size_t i = 0; i < marks.size(); ++i)
    EXPECT_LT((marks[i].position - places[marks[i].slot]).norm(), kMillimetre);
}

TEST(History, ShowsAnyInstantAsTheInspectorDoes) {
  const auto all = trucks::drive(5, 40);
  History history(whole());
  take(history, all);
  history.roster().publish();
  std::unique_ptr<History::Cursor> cursor;
  // Forward, back, far forward, to an update itself, to the end.
  for (const nanoseconds since : std::initializer_list<nanoseconds>{
           seconds(3), milliseconds(12'345), seconds(7), milliseconds(39'004), milliseconds(20'502),
           nanoseconds(0), seconds(39)}) {
    history.seek(cursor, kStart + since);
    expect_same(marks_of(cursor->world(), history, cursor->time()),
                shown_by_table(all, std::max(kStart + since, history.begin())));
  }
}

TEST(History, ComesToTheSameWorldFromEitherSide) {
  const auto all = trucks::drive(3, 30);
  History history(whole());
  take(history, all);
  history.roster().publish();
  std::unique_ptr<History::Cursor> forward, backward;
  for (int second = 0; second <= 20; ++second) history.seek(forward, kStart + seconds(second));
  history.seek(backward, kStart + seconds(29));
  history.seek(backward, kStart + seconds(20));
  const auto a = marks_of(forward->world(), history, forward->time());
  const auto b = marks_of(backward->world(), history, backward->time());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].error, b[i].error);
  }
}

TEST(History, ShowsAndRemovesTheErrorOfAnUpdate) {
  History history(whole());
  Sent first{{}, kStart}, second{{}, kStart + seconds(1)};
  pdu::EntityState state = trucks::truck(1, 0);
  state.linear_velocity = {0, 0, 0};
  test::append_pdu(first.octets, state);
  state.header.timestamp = pdu::to_dis_timestamp(second.time, true);
  state.location.y += 1;
  test::append_pdu(second.octets, state);
  take(history, {first, second});
  history.roster().publish();
  const auto error_at = [&](nanoseconds time) {
    return marks_of(history.live(), history, time).at(0).error.norm();
  };
  EXPECT_NEAR(error_at(second.time), 1.0, 1e-6);
  EXPECT_LT(error_at(second.time + milliseconds(400)), 0.9);
  EXPECT_EQ(error_at(second.time + seconds(2)), 0.0);
  EXPECT_NEAR(marks_of(history.live(), history, second.time).at(0).jump, 1.0, 1e-6);
}

TEST(History, ShowsAMillimetreSixThousandKilometresAway) {
  History history(whole());
  Sent near{{}, kStart}, far{{}, kStart}, moved{{}, kStart + seconds(1)};
  pdu::EntityState walker = trucks::truck(2, 0);
  walker.linear_velocity = {0, 0, 0};
  constexpr double kAngle = 0.98;  // [rad] of longitude: a chord of 6,000 km
  walker.location = {trucks::kRadius * std::cos(kAngle), trucks::kRadius * std::sin(kAngle), 0};
  test::append_pdu(near.octets, trucks::truck(1, 0));
  test::append_pdu(far.octets, walker);
  walker.header.timestamp = pdu::to_dis_timestamp(moved.time, true);
  walker.location.z += 0.001;  // to the north
  test::append_pdu(moved.octets, walker);
  take(history, {near, far, moved});
  history.roster().publish();
  std::unique_ptr<History::Cursor> cursor;
  history.seek(cursor, kStart + milliseconds(999));
  const EntityMark before = marks_of(cursor->world(), history, cursor->time()).at(1);
  const EntityMark after = marks_of(history.live(), history, moved.time).at(1);
  EXPECT_NEAR(before.position.norm(), 6.0e6, 0.02e6);
  EXPECT_NEAR(after.position.y() - before.position.y(), 0.001, 1e-8);
  EXPECT_NEAR(after.error.y(), -0.001F, 1e-8F) << "shown where it was";
}

TEST(History, FindsTheUpdatesBesideAnInstant) {
  const auto all = trucks::drive(2, 4);
  History history(whole());
  take(history, all);
  EXPECT_EQ(history.update_after(kStart + milliseconds(1)), kStart + milliseconds(2));
  EXPECT_EQ(history.update_before(kStart + milliseconds(501)), kStart + milliseconds(2));
  EXPECT_EQ(history.update_after(all.back().time), std::nullopt);
  EXPECT_EQ(history.update_before(all.front().time), std::nullopt);
}

TEST(History, KeepsTheLastMinuteOfALiveSource) {
  HistoryOptions options;
  options.span = seconds(60);
  History history(options);
  const auto all = trucks::drive(4, 200);
  for (const Sent& sent : all) {
    ASSERT_TRUE(history.take(datagram_of(sent)));
    history.pass(sent.time);
  }
  EXPECT_LE(history.begin(), history.end() - seconds(60));
  EXPECT_GE(history.begin(), history.end() - seconds(95));
  history.roster().publish();
  const nanoseconds wanted = history.end() - milliseconds(59'300);
  std::unique_ptr<History::Cursor> cursor;
  history.seek(cursor, wanted);
  expect_same(marks_of(cursor->world(), history, wanted), shown_by_table(all, wanted));
  // A forgotten instant is shown as the beginning.
  history.seek(cursor, kStart);
  EXPECT_EQ(cursor->time(), history.begin());
}

TEST(History, StaysWithinItsOctets) {
  HistoryOptions options;
  options.octets = 200'000;
  History live(options);
  for (const Sent& sent : trucks::drive(4, 300)) {
    ASSERT_TRUE(live.take(datagram_of(sent)));
    live.pass(sent.time);
    ASSERT_LE(live.weight(), 2 * options.octets);
  }
  options.span.reset();
  History capture(options);
  bool is_full = false;
  for (const Sent& sent : trucks::drive(4, 300))
    is_full = is_full || !capture.take(datagram_of(sent));
  EXPECT_TRUE(is_full);
  EXPECT_LE(capture.weight(), options.octets + 1000);
}

TEST(History, ReceivesOneExerciseIfConfigured) {
  HistoryOptions options = whole();
  options.exercise = 9;
  History history(options);
  take(history, trucks::drive(2, 1));
  EXPECT_TRUE(history.live().table().entities().empty());
}

TEST(History, ReturnsRatesAndErrorsOfThePreviousSecond) {
  History history(whole());
  take(history, trucks::drive(4, 10));
  const NumbersSample* sample = history.numbers().at(kStart + seconds(5));
  ASSERT_NE(sample, nullptr);
  EXPECT_NEAR(sample->pdu_per_s, 8, 4);
  EXPECT_NEAR(sample->bit_per_s, 8 * 144 * sample->pdu_per_s, 1);
  // Half a second at 2 m/s^2 towards the centre: 0.25 m.
  EXPECT_NEAR(sample->error_mean.value(), 0.25, 0.01);
  EXPECT_FALSE(sample->lost_share.has_value());
  EXPECT_EQ(history.numbers().at(kStart), nullptr);
}

/// A scene of 8 groups of cells at 239.192.1.1, then near groups, then contact groups.
GroupTiers three_tiers() {
  peer::AoimConfig aoim;
  aoim.pool = 8;
  aoim::Channel near, far;
  near.farthest = 10;
  aoim.tiers = peer::distance_tiers(std::array{near, far}, false);
  aoim.tiers[0].own_group = true;
  aoim.tiers.insert(aoim.tiers.begin(), {peer::Recipients::touch, {}, false});
  return {peer::NetworkConfig{}, aoim};
}

peer::GroupAddress group_number(std::uint32_t number, std::uint16_t port = 3000) {
  return peer::IpEndpoint::v4(0xEFC00100 + number, port);
}

TEST(GroupTiers, DistinguishNearAndContactGroupsFromCells) {
  const GroupTiers tiers = three_tiers();
  for (const std::uint32_t number : {0U, 1U, 8U, 25U})
    EXPECT_EQ(tiers.of(group_number(number)).number, 0) << number;
  EXPECT_EQ(tiers.of(group_number(9)).tier, GroupTier::near);
  EXPECT_EQ(tiers.of(group_number(16)).tier, GroupTier::near);
  EXPECT_EQ(tiers.of(group_number(17)).tier, GroupTier::contact);
  EXPECT_EQ(tiers.of(group_number(24)).number, 24);
  EXPECT_EQ(tiers.of(group_number(24, 3001)).number, 24) << "sealed";
  EXPECT_EQ(tiers.of(peer::IpEndpoint::v4(0x7F000001, 3000)).number, 0);
  EXPECT_EQ(GroupTiers().of(group_number(24)).number, 0) << "no scene, no knowledge";
}

TEST(ReceivedGroups, KnowRecentSendersOfAContactGroup) {
  HistoryOptions options = whole();
  options.tiers = three_tiers();
  History history(options);
  const auto hear = [&](std::uint16_t number, double t, std::uint32_t group) {
    Sent sent{{}, kStart + nanoseconds(std::llround(1e9 * t))};
    test::append_pdu(sent.octets, trucks::truck(number, t));
    peer::SourceDatagram datagram = datagram_of(sent);
    datagram.group = group_number(group);
    ASSERT_TRUE(history.take(datagram));
  };
  hear(1, 0.0, 17);
  hear(2, 0.1, 17);
  hear(3, 0.2, 2);  // by its cell's group
  hear(2, 1.0, 9);
  hear(2, 1.2, 2);
  const auto at = [&](nanoseconds time) {
    return history.live().groups().shared_at(kStart + time);
  };
  const auto shared = at(milliseconds(1200));
  ASSERT_EQ(shared.size(), 2U);
  EXPECT_EQ(shared[0].group.number, 9);
  EXPECT_EQ(shared[0].slots, (std::vector<std::uint16_t>{1}));
  EXPECT_EQ(shared[1].group.tier, GroupTier::contact);
  EXPECT_EQ(shared[1].slots, (std::vector<std::uint16_t>{0, 1}));
  EXPECT_EQ(at(milliseconds(3050)).at(1).slots, (std::vector<std::uint16_t>{1}));
  EXPECT_TRUE(at(seconds(5)).empty()) << "not of late";
  std::unique_ptr<History::Cursor> cursor;
  history.seek(cursor, kStart + milliseconds(50));
  EXPECT_EQ(cursor->world().groups().shared_at(cursor->time()).at(0).slots.size(), 1U);
}

/// The roles of a peer that carries one beacon.
Sent roles(std::uint32_t tag, std::int32_t column, std::uint16_t flags, double t) {
  Sent sent{{}, kStart + nanoseconds(std::llround(1e9 * t))};
  pdu::CellRoles roles;
  roles.simulation = {1, 2};
  test::Octets octets(pdu::kFixedSize<pdu::CellRole>);
  pdu::CellRole role;
  role.column = column;
  role.beacon = tag;
  role.flags = flags;
  EXPECT_GT(pdu::store_record(role, octets), 0U);
  roles.roles = octets;
  test::append_pdu(sent.octets, roles);
  return sent;
}

TEST(ReceivedGroups, KnowABeaconsCellUntilItLeaves) {
  History history(whole());
  take(history, {roles(7, 3, 0, 0), roles(7, 4, 0, 1), roles(7, 3, pdu::kRoleLeaves, 1.1)});
  const auto& beacons = history.live().groups().beacons();
  ASSERT_EQ(beacons.size(), 1U) << "it has left another cell";
  EXPECT_EQ(beacons.at(7).cell.column, 4);
  EXPECT_EQ(beacons.at(7).owner, (pdu::SimulationAddress{1, 2}));
  EXPECT_EQ(beacons.at(7).received, kStart + seconds(1));
  take(history, {roles(7, 4, pdu::kRoleLeaves, 2)});
  EXPECT_TRUE(beacons.empty());
}

TEST(ReceivedGroups, ReplaceSilentBeaconsAtTheirLimit) {
  History history(whole());
  for (std::uint32_t tag = 1; tag <= 2000; ++tag) take(history, {roles(tag, 0, 0, 0.001 * tag)});
  EXPECT_EQ(history.live().groups().beacons().size(), ReceivedGroups::kMostBeacons);
  take(history, {roles(5000, 0, 0, 60)});
  EXPECT_TRUE(history.live().groups().beacons().contains(5000));
}

TEST(Roster, NamesShownEntitiesAndReusesSlots) {
  HistoryOptions options;
  options.span = seconds(5);
  History history(options);
  Sent one{{}, kStart};
  test::append_pdu(one.octets, trucks::truck(7, 0, "<b>&\"'"));
  take(history, {one});
  EXPECT_TRUE(marks_of(history.live(), history, kStart).empty()) << "not named yet";
  EXPECT_TRUE(history.roster().publish());
  EXPECT_FALSE(history.roster().publish()) << "nothing changed";
  const auto message = nlohmann::json::parse(history.roster().message());
  EXPECT_EQ(message["type"], "roster");
  EXPECT_EQ(message["epoch"], 1);
  const auto& entity = message["entities"].at(0);
  EXPECT_EQ(entity["slot"], 0);
  EXPECT_EQ(entity["id"], "1:2:7");
  EXPECT_EQ(entity["marking"], "<b>&\"'");
  EXPECT_EQ(entity["kind"], "platform land");
  EXPECT_EQ(entity["side"], "friendly");
  EXPECT_FALSE(entity.contains("force"));
  EXPECT_EQ(entity["haptic"], false);
  EXPECT_EQ(entity["peer"], "1:2");
  EXPECT_EQ(marks_of(history.live(), history, kStart).size(), 1U);

  Sent other{{}, kStart + seconds(600)};
  test::append_pdu(other.octets, trucks::truck(8, 600));
  take(history, {other});
  history.pass(other.time + seconds(40));
  other.time += seconds(41);
  take(history, {other});
  history.pass(other.time);
  history.roster().publish();
  EXPECT_EQ(nlohmann::json::parse(history.roster().message())["entities"].size(), 1U);
}

TEST(Roster, HasNoSlotForMoreThanItsBound) {
  HistoryOptions options = whole();
  options.entities = 3;
  History history(options);
  take(history, trucks::drive(9, 1));
  EXPECT_EQ(history.roster().size(), 3U);
  history.roster().publish();
  EXPECT_EQ(marks_of(history.live(), history, kStart + milliseconds(900)).size(), 3U);
}

}  // namespace
}  // namespace reckon::tools::history_test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers kilometres apart: one follows the beacon of another peer's entity, and shows it
// anywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/integration/field_of_peers.hpp"
#include "reckon/tools/exercise/leaders_report.hpp"

namespace reckon::test::beacons_test {
namespace {

constexpr std::size_t kFollower = 0, kOwner = 1, kBystander = 2, kRival = 3;
constexpr double kFar = 10'000.0;  // [m]
// The threshold of 1 m, and the effect of 4 ms delay at 40 m/s.
constexpr double kMost = 1.2;  // [m]

std::string handing_out() {
  return with(kField, "leaders = true\n", "leaders = true\nhand_out = true\n");
}

// Three posts in a row, 10 km apart, and a truck of the second peer with a beacon.
class FollowedTruck : public testing::Test {
 protected:
  FollowedTruck() : field_(4, handing_out()), following_(field_.scene_) {
    following_.aoim.follow = "gate";
    field_.world_.start(kFollower, following_);
    stand(kFollower, -kFar);
    field_.start(kBystander, 1, false, kFar);
  }
  void stand(std::size_t link, double east) {
    field_.world_.peer(link).model().add(1, post(), field_.truth({east, 0, 0}));
  }
  [[nodiscard]] static peer::EntityDescription post(std::string beacon = {}) {
    peer::EntityDescription post;
    post.marking = "TRUCK";
    post.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
    post.dead_reckoning.heartbeat = seconds(60);
    post.beacon = std::move(beacon);
    return post;
  }
  void start_owner(std::size_t link = kOwner, double east = 0.0) {
    field_.world_.start(link, field_.scene_);
    field_.world_.peer(link).model().add(1, post("gate"), field_.truth({east, 0, 0}));
  }
  [[nodiscard]] const peer::RemoteEntity* seen(std::size_t by, std::uint16_t of = kOwner + 1) {
    return field_.world_.peer(by).model().remote().find({1, of, 1});
  }
  [[nodiscard]] const peer::LeadersView::Followed& followed() {
    return field_.world_.view(kFollower).leaders.followed[0];
  }
  /// Drives the truck to the east for `length` [s].
  void drive(double speed, std::size_t length) {
    for (std::size_t ms = 0; ms < 1000 * length; ms += 10) {
      east_ += 0.01 * speed;
      peer::EntityTruth truth = field_.truth({east_, 0, 0});
      truth.velocity = {speed, 0, 0};
      field_.world_.peer(kOwner).model().move(1, truth);
      field_.world_.run(10);
      ++looks_;
      const auto* truck = seen(kFollower);
      if (truck == nullptr) {
        ++missing_;
        continue;
      }
      const nanoseconds now = field_.world_.clock().now();
      const Eigen::Vector3d place = field_.truth({east_, 0, 0}).position;
      worst_ = std::max(worst_, (truck->predicted(now).position - place).norm());
    }
  }

  Field field_;
  peer::SceneFile following_;
  double east_ = 0.0, worst_ = 0.0;  // [m]
  std::size_t looks_ = 0, missing_ = 0;
};

TEST_F(FollowedTruck, IsSeenFromTenKilometresAway) {
  field_.world_.run(4000);
  EXPECT_FALSE(followed().found);
  start_owner();
  const std::size_t found = field_.world_.run_until([&] { return followed().found; }, 5000);
  const std::size_t took =
      found + field_.world_.run_until([&] { return seen(kFollower) != nullptr; }, 5000);
  std::printf("found %zu and seen %zu ms after its owner started\n", found, took);
  EXPECT_LT(took, 1000U);
  field_.world_.run(1000);
  EXPECT_EQ(seen(kBystander), nullptr) << "it does not follow";
  EXPECT_TRUE(followed().found);
  EXPECT_STREQ(followed().name.data(), "gate");
  const auto& view = field_.world_.view(kFollower);
  EXPECT_THAT(tools::leaders_json(view.leaders),
              testing::HasSubstr(R"("followed":[{"beacon":"gate","cell":"0,0","group":)"));
}

TEST_F(FollowedTruck, IsShownOnBordersAndCornersOfCells) {
  const double edge = 50.0;  // [m] from the centre of a cell
  std::uint32_t life = 500;
  for (const auto& [east, north] : {std::pair{edge, 0.0}, {edge, edge}, {edge + 9900, -edge}}) {
    SCOPED_TRACE(testing::Message() << east << " m, " << north << " m");
    field_.world_.start(kOwner, field_.scene_, ++life, 1 + kOwner);
    field_.world_.peer(kOwner).model().add(1, post("gate"), field_.truth({east, north, 0}));
    const auto is_seen = [&] { return seen(kFollower) != nullptr; };
    EXPECT_LT(field_.world_.run_until(is_seen, 8000), 8000U);
    field_.world_.run(3000);
    EXPECT_TRUE(is_seen());
    field_.world_.kill(kOwner);
    field_.world_.run(30'000);
  }
}

TEST_F(FollowedTruck, IsShownInEachCellThatItEnters) {
  start_owner();
  field_.world_.run(6000);
  ASSERT_NE(seen(kFollower), nullptr);
  drive(40.0, 30);
  std::printf("12 borders in 30 s: off by %.3f m at most, missing in %zu of %zu looks\n", worst_,
              missing_, looks_);
  EXPECT_EQ(missing_, 0U);
  EXPECT_LT(worst_, kMost);
  EXPECT_EQ(field_.world_.count(kFollower, "datagrams_lost"), 0U);
  EXPECT_THAT(field_.world_.notices(kOwner),
              testing::Not(testing::Contains(testing::HasSubstr("another peer's"))))
      << "the map of groups is only a moment behind the truck";
}

TEST_F(FollowedTruck, IsGoneWithItsOwner) {
  start_owner();
  field_.world_.run(6000);
  ASSERT_TRUE(followed().found);
  const std::size_t groups = field_.world_.view(kFollower).groups;
  field_.world_.kill(kOwner);
  field_.world_.run(30'000);
  EXPECT_FALSE(followed().found);
  EXPECT_EQ(seen(kFollower), nullptr);
  EXPECT_LT(field_.world_.view(kFollower).groups, groups) << "its group is left";
  start_owner(kRival, 2100.0);
  field_.world_.run(3000);
  EXPECT_TRUE(followed().found);
  EXPECT_NE(seen(kFollower, kRival + 1), nullptr);
}

TEST_F(FollowedTruck, SecondOwnerOfABeaconWaitsForFirst) {
  start_owner();
  field_.world_.run(6000);
  start_owner(kRival, 2100.0);
  field_.world_.run(8000);
  EXPECT_NE(seen(kFollower), nullptr);
  EXPECT_EQ(seen(kFollower, kRival + 1), nullptr);
  const auto complaint = testing::Contains(testing::HasSubstr("another peer carries beacon gate"));
  EXPECT_THAT(field_.world_.notices(kRival), complaint);
  EXPECT_THAT(field_.world_.notices(kOwner), testing::Not(complaint));
  field_.world_.stop(kOwner);
  field_.world_.run(3000);
  EXPECT_NE(seen(kFollower, kRival + 1), nullptr);
}

// A Cell Roles PDU and a trailer with `epoch`: its beacon is far away.
std::vector<std::byte> forged_beacon(std::uint32_t epoch, std::uint32_t sequence) {
  pdu::CellRole role;
  role.column = 5;
  role.row = 5;
  role.entered = 1;
  role.beacon = aoim::beacon_tag("gate");
  std::array<std::byte, pdu::kFixedSize<pdu::CellRole>> record;
  EXPECT_GT(pdu::store_record(role, record), 0U);
  pdu::CellRoles roles;
  roles.header.exercise_id = 1;
  roles.simulation = {1, kOwner + 1};
  roles.epoch = epoch;
  roles.roles = record;
  pdu::DatagramTrailer trailer;
  trailer.header.exercise_id = 1;
  trailer.epoch = epoch;
  trailer.sequence = sequence;
  std::vector<std::byte> octets(pdu::wire_size(roles) + pdu::kDatagramTrailerSize);
  const std::size_t size = pdu::encode(roles, octets);
  EXPECT_GT(pdu::encode(trailer, std::span(octets).subspan(size)), 0U);
  return octets;
}

TEST_F(FollowedTruck, IsNotMovedByAStranger) {
  start_owner();
  field_.world_.run(6000);
  const std::size_t groups = field_.world_.view(kFollower).groups;
  for (std::uint32_t i = 0; i < 50; ++i) {
    for (const std::uint32_t epoch : {100U + static_cast<std::uint32_t>(kOwner), 0xBADU}) {
      ASSERT_TRUE(field_.world_.network().link(4).send(field_.scene_.network.group,
                                                       forged_beacon(epoch, (1U << 30) + i)));
    }
    field_.world_.run(100);
    ASSERT_TRUE(followed().found);
    ASSERT_EQ(followed().column, 0);
    ASSERT_EQ(field_.world_.view(kFollower).groups, groups);
  }
  EXPECT_NE(seen(kFollower), nullptr);
}

}  // namespace
}  // namespace reckon::test::beacons_test

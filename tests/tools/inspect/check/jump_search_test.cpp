// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Jumps of entities: injected ones are found with frame, time, entity and size, and distinguished
// from each other; motion with another cause is no jump.
#include "reckon/tools/inspect/check/jump_search.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/tools/support/checked_traffic.hpp"

namespace reckon::tools::jump_search_test {
namespace {

using namespace checks;
using nlohmann::json;
using test::Sender;
using ::testing::EndsWith;
using ::testing::HasSubstr;

/// One update for a capture.
struct Update {
  pdu::EntityState pdu;
  nanoseconds arrival{};
  Sender sender;
};
using Updates = std::vector<Update>;

/// `count` updates of the truck, one a second.
Updates trucks(int count) {
  Updates updates;
  for (int i = 0; i < count; ++i) updates.push_back({truck(seconds(i)), kStart + seconds(i), {}});
  return updates;
}

void shift(Update& update, double metres) { update.pdu.location.z += metres; }
void shift_from(Updates& updates, std::size_t first, double metres) {
  for (std::size_t i = first; i < updates.size(); ++i) shift(updates[i], metres);
}

/// The position findings of check: teleports, spikes and duplicate IDs.
std::vector<json> jumps_of(const Updates& updates) {
  CaptureBuilder capture;
  for (const Update& update : updates)
    capture.add(datagram_of(update.pdu), update.arrival, update.sender);
  std::vector<json> found = check(capture.path()).findings;
  std::erase_if(found, [](const json& finding) {
    const std::string rule = finding["rule"];
    return rule != "W-TELEPORT" && rule != "W-SPIKE" && rule != "W-DUPLICATE-ID";
  });
  return found;
}

std::vector<std::string> rules_of(const Updates& updates) {
  std::vector<std::string> rules;
  for (const json& finding : jumps_of(updates)) rules.push_back(finding["rule"]);
  return rules;
}

const std::vector<std::string> kNone;
using Rules = std::vector<std::string>;

TEST(JumpSearch, FindsATeleportWithItsFrameAndSize) {
  Updates updates = trucks(20);
  shift_from(updates, 12, 500);
  const auto found = jumps_of(updates);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]["rule"], "W-TELEPORT");
  EXPECT_EQ(found[0]["frame"], 13);
  EXPECT_EQ(found[0]["at"], 48);
  EXPECT_EQ(found[0]["id"], "1:2:3");
  EXPECT_EQ(found[0]["time"], 1'700'000'012.0);
  EXPECT_NEAR(found[0]["metres"], 500, 0.1);
  EXPECT_THAT(found[0]["reason"].get<std::string>(), HasSubstr("500 m at 12.000 s; "));
  EXPECT_NEAR(found[0]["degrees"], 0, 1e-3);
  for (std::size_t i = 12; i < updates.size(); ++i) updates[i].pdu.orientation.psi = -3.0F;
  const json turned = jumps_of(updates).at(0);
  EXPECT_NEAR(turned["degrees"], 171.887, 1e-3);
  EXPECT_THAT(turned["reason"].get<std::string>(), EndsWith("; turned 172 deg"));
}

TEST(JumpSearch, DistinguishesASpikeFromATeleport) {
  Updates updates = trucks(20);
  shift(updates[7], 500);
  const auto found = jumps_of(updates);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0]["rule"], "W-SPIKE");
  EXPECT_EQ(found[0]["frame"], 8);
  EXPECT_NEAR(found[0]["metres"], 500, 0.1);
  EXPECT_THAT(found[0]["reason"].get<std::string>(), HasSubstr("7.000 s, back with the next"));
}

TEST(JumpSearch, FindsSeveralIncludingTheLast) {
  Updates updates = trucks(20);
  shift_from(updates, 4, 500);
  shift_from(updates, 9, -300);
  shift(updates[15], 80);
  shift(updates[19], 90);
  EXPECT_EQ(rules_of(updates), (Rules{"W-TELEPORT", "W-TELEPORT", "W-SPIKE", "W-TELEPORT"}));
}

TEST(JumpSearch, FindsJumpsOfAJetBetweenHeartbeats) {
  Updates updates;
  for (int i = 0; i < 8; ++i) {
    pdu::EntityState pdu = truck(seconds(5 * i));
    pdu.entity_type.domain = pdu::EntityDomain::air;
    pdu.location.y = 5.0 * 300 * i;
    pdu.linear_velocity.y = 300;
    updates.push_back({pdu, kStart + seconds(5 * i), {}});
  }
  EXPECT_EQ(rules_of(updates), kNone);
  shift_from(updates, 4, 500);
  EXPECT_EQ(rules_of(updates), Rules{"W-TELEPORT"});
}

TEST(JumpSearch, FindsATeleportWithAMatchingVelocity) {
  Updates updates = trucks(20);
  shift_from(updates, 12, 500);
  updates[12].pdu.linear_velocity.z = 500;  // 500 m in the second since the update before
  EXPECT_EQ(rules_of(updates), Rules{"W-TELEPORT"});
}

TEST(JumpSearch, FindsJumpsInEveryDeadReckoningModel) {
  for (int drm = 0; drm <= 9; ++drm) {
    SCOPED_TRACE(drm);
    Updates updates = trucks(12);
    for (Update& update : updates)
      update.pdu.dead_reckoning.algorithm = static_cast<pdu::DeadReckoningAlgorithm>(drm);
    // Body axes: x forward, which these angles put on the earth's y axis.
    const bool body = drm >= 6;
    for (Update& update : updates)
      if (body) {
        update.pdu.orientation.psi = 1.57079633F;
        update.pdu.linear_velocity = {10, 0, 0};
      }
    EXPECT_EQ(rules_of(updates), kNone);
    shift_from(updates, 6, 500);
    EXPECT_EQ(rules_of(updates), Rules{"W-TELEPORT"});
  }
}

TEST(JumpSearch, TakesThresholdCrossingsAndTurnsForNone) {
  Updates updates;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.7 * i;
    const double angle = std::sin(0.9 * t) * 2;  // sharp turns back and forth at 25 m/s
    pdu::EntityState pdu = truck(milliseconds(700 * i));
    const auto& last = updates.empty() ? pdu : updates.back().pdu;
    pdu.location.y = last.location.y + 0.7 * last.linear_velocity.y;
    pdu.location.z = last.location.z + 0.7 * last.linear_velocity.z + (i % 3) * 0.9;
    pdu.linear_velocity = {0, static_cast<float>(25 * std::cos(angle)),
                           static_cast<float>(25 * std::sin(angle))};
    updates.push_back({pdu, kStart + milliseconds(700 * i), {}});
  }
  EXPECT_EQ(rules_of(updates), kNone);
}

TEST(JumpSearch, TakesLostUpdatesForNone) {
  // A car turns a corner, received every 10 s instead of every second.
  Updates updates = trucks(2);
  pdu::EntityState late = truck(seconds(11));
  late.location.y = 20;
  late.location.z = 90;
  late.linear_velocity = {0, 0, 10};
  updates.push_back({late, kStart + seconds(11), {}});
  EXPECT_EQ(rules_of(updates), kNone);
}

TEST(JumpSearch, TakesReturnsAfterATimeOutForNone) {
  Updates updates = trucks(8);
  for (std::size_t i = 4; i < 8; ++i) {
    updates[i].pdu.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(i + 300), true);
    updates[i].arrival += seconds(300);
  }
  shift_from(updates, 4, 5000);
  EXPECT_EQ(rules_of(updates), kNone);
}

TEST(JumpSearch, ReportsTwoSendersInsteadOfJumps) {
  Updates updates = trucks(20);
  for (std::size_t i = 1; i < updates.size(); i += 2) {
    shift(updates[i], 5000);
    updates[i].sender.host = 9;
  }
  EXPECT_EQ(rules_of(updates), Rules{"W-DUPLICATE-ID"});
}

TEST(JumpSearch, ReportsAlternatingPlacesOfOneSenderOnce) {
  Updates updates = trucks(20);
  for (std::size_t i = 1; i < updates.size(); i += 2) shift(updates[i], 5000);
  const auto found = jumps_of(updates);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0]["rule"], "W-SPIKE");
  EXPECT_EQ(found[1]["rule"], "W-DUPLICATE-ID");
  EXPECT_THAT(found[1]["reason"].get<std::string>(),
              HasSubstr("alternates between two positions, 5000 m apart"));
}

TEST(JumpSearch, TakesARestartedProgramForNone) {
  Updates updates = trucks(20);
  for (std::size_t i = 10; i < updates.size(); ++i) updates[i].sender.port = 4000;
  shift_from(updates, 10, 5000);
  EXPECT_EQ(rules_of(updates), kNone);
}

TEST(JumpSearch, TakesTimestampsThatJumpForNone) {
  Updates updates = trucks(20);
  for (std::size_t i = 10; i < updates.size(); ++i)
    updates[i].pdu.header.timestamp = pdu::to_dis_timestamp(kStart + seconds(i + 40), true);
  EXPECT_EQ(rules_of(updates), kNone);
  for (std::size_t i = 10; i < updates.size(); ++i)
    updates[i].pdu.header.timestamp = pdu::to_dis_timestamp(kStart - seconds(100 - i), true);
  EXPECT_EQ(rules_of(updates), kNone);
}

TEST(JumpSearch, TakesAReplayWithoutPausesForNone) {
  Updates updates = trucks(20);
  for (std::size_t i = 0; i < updates.size(); ++i)
    updates[i].arrival = kStart + nanoseconds(1000 * i);
  EXPECT_EQ(rules_of(updates), kNone);
  shift_from(updates, 12, 500);
  EXPECT_EQ(rules_of(updates), Rules{"W-TELEPORT"});
}

TEST(JumpSearch, TakesCapturesThatAreSortedBadlyForNone) {
  Updates updates = trucks(40);
  for (std::size_t i = 3; i + 2 < updates.size(); i += 4) std::swap(updates[i], updates[i + 2]);
  EXPECT_EQ(rules_of(updates), kNone);
}

TEST(JumpSearch, TakesMotionWithoutVelocityForNone) {
  Updates updates = trucks(20);
  for (std::size_t i = 0; i < updates.size(); ++i) {
    updates[i].pdu.location.y *= 20;  // 200 m/s
    updates[i].pdu.linear_velocity = {};
  }
  EXPECT_EQ(rules_of(updates), kNone);
}

TEST(JumpSearch, PassesOverPlacesThatAreNoNumbers) {
  Updates updates = trucks(20);
  updates[7].pdu.location.z = std::nan("");
  EXPECT_EQ(rules_of(updates), kNone);
  updates[12].pdu.location = {};  // the centre of the earth is a position
  EXPECT_EQ(rules_of(updates), Rules{"W-SPIKE"});
}

}  // namespace
}  // namespace reckon::tools::jump_search_test

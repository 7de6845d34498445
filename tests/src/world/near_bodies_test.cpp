// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/near_bodies.hpp"

#include <gtest/gtest.h>

#include <array>

namespace reckon::peer {
namespace {

TEST(NearBodies, AreLargerAsProbesWhereTheyMayTouchAlready) {
  RemoteEntity row;
  row.model.radius = 0.01;
  row.type.kind = pdu::EntityKind::life_form;
  NearBody body;
  body.row = &row;
  body.centre = {1, 2, 3};
  std::array bodies{body, body, body, body};
  bodies[0].depth = 0.001;    // touches
  bodies[1].depth = -0.0004;  // nearly
  bodies[2].depth = -0.0006;
  bodies[3].depth = -1;
  std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
  ASSERT_EQ(to_probes(bodies, 0.0005, probes), 4u);
  EXPECT_EQ(probes[0].radius, 0.01);
  EXPECT_EQ(probes[1].radius, 0.0105);
  EXPECT_EQ(probes[2].radius, 0.01);
  EXPECT_EQ(probes[3].radius, 0.01);
  EXPECT_EQ(probes[1].position, body.centre);
}

TEST(NearBodies, AreNoProbesWhereNobodyHoldsThem) {
  RemoteEntity hand, peg;
  hand.type.kind = pdu::EntityKind::life_form;
  peg.type.kind = pdu::EntityKind::cultural_feature;
  std::array<NearBody, 2> bodies;
  bodies[0].row = &peg;
  bodies[1].row = &hand;
  bodies[1].centre = {1, 2, 3};
  std::array<deadreckon::ProbeState, haptics::kMaxRemoteHands> probes;
  ASSERT_EQ(to_probes(bodies, 0.0005, probes), 1u);
  EXPECT_EQ(probes[0].position, bodies[1].centre);
}

}  // namespace
}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// No peer has the site of the scene, whose entities are the bodies.
#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "reckon/tests/aoim/support/segment.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

TEST(SceneSite, IsRefusedToOtherPeers) {
  Presence presence({}, presence_of(1, 11));
  pdu::Presence taken = presence_of(2, 22);
  taken.simulation = kSceneId;
  for (int i = 0; i < 3; ++i) presence.receive(taken, seconds(1 + i), source(2));
  taken.simulation.application = 9;
  presence.receive(taken, seconds(5), source(3));
  EXPECT_TRUE(presence.peers().empty());
  EXPECT_EQ(presence.counts().reserved, 4u);
  EXPECT_EQ(kinds(presence), (std::vector{Kind::impostor, Kind::impostor}))
      << "once for each address";
}

TEST(SceneSite, KnownPeersCannotMoveThere) {
  Presence presence({}, presence_of(1, 11));
  presence.receive(presence_of(2, 22), seconds(1), source(2));
  pdu::Presence taken = presence_of(2, 22);
  taken.simulation = kSceneId;
  presence.receive(taken, seconds(2), source(2));
  EXPECT_EQ(presence.id_of(22), (PeerId{7, 2}));
  EXPECT_EQ(presence.epoch_of(kSceneId), std::nullopt);
}

TEST(SceneSite, IsRefusedToThisPeer) {
  pdu::Presence own = presence_of(1, 11);
  own.simulation = kSceneId;
  try {
    const Presence presence({}, own);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "site 65534 belongs to the scene's bodies: choose 1 to 65533");
  }
}

}  // namespace
}  // namespace reckon::aoim

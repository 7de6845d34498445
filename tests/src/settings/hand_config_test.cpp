// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/hand_config.hpp"

#include <gtest/gtest.h>

namespace reckon::peer {
namespace {

TEST(HandModel, IsSentAsASphereAboutTheHand) {
  HandModel hand;
  hand.radius = 0.03;
  hand.k1 = 500;
  hand.k3 = 2e6;
  hand.damping = 1.5;
  hand.static_friction = 0.5;
  hand.kinetic_friction = 0.25;
  hand.validity = std::chrono::milliseconds(12500);

  const deadreckon::ForceModel model = to_force_model(hand);
  EXPECT_EQ(model.kind, pdu::ForceModelKind::sphere);
  EXPECT_EQ(model.radius, 0.03);
  EXPECT_EQ(model.k1, 500);
  EXPECT_EQ(model.k3, 2e6);
  EXPECT_EQ(model.damping, 1.5);
  EXPECT_EQ(model.static_friction, 0.5);
  EXPECT_EQ(model.kinetic_friction, 0.25);
  EXPECT_EQ(model.validity, 12.5);
  EXPECT_EQ(model.point, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hands of a demo that pages may move.
#include "reckon/tools/verbs/demo_page.hpp"

#include <gtest/gtest.h>

namespace reckon::tools {
namespace {

using peer::DeviceSource;

peer::SceneFile two_operators(double damping) {
  peer::SceneFile scene;
  scene.operators.resize(2);
  scene.operators[1].damping = damping;
  return scene;
}

TEST(LetPagesMoveHands, GivesEachHandAPointerByDefault) {
  peer::SceneFile scene = two_operators(3.0);
  let_pages_move_hands(scene, 2);
  ASSERT_EQ(scene.devices.size(), 2u);
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene.devices[i].source, DeviceSource::pointer);
    EXPECT_EQ(scene.devices[i].peer, i + 1);
    EXPECT_EQ(scene.devices[i].operator_number, i + 1);
  }
}

TEST(LetPagesMoveHands, LeavesAGripWithoutDampingToItsOperator) {
  peer::SceneFile scene = two_operators(0.0);
  let_pages_move_hands(scene, 2);
  ASSERT_EQ(scene.devices.size(), 2u);
  EXPECT_EQ(scene.devices[0].source, DeviceSource::pointer);
  EXPECT_EQ(scene.devices[1].source, DeviceSource::simulated);
}

TEST(LetPagesMoveHands, LeavesASceneWithItsOwnPointer) {
  peer::SceneFile scene = two_operators(3.0);
  scene.devices.resize(2);
  scene.devices[1].source = DeviceSource::pointer;
  let_pages_move_hands(scene, 2);
  EXPECT_EQ(scene.devices[0].source, DeviceSource::simulated);
}

}  // namespace
}  // namespace reckon::tools

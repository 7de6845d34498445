// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies in scene files: their keys, refusals, and their part of the scene hash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer {
namespace {

using test::refusal;
using testing::HasSubstr;

constexpr const char* kHand = "[[operator]]\npassive = true\n[[device]]\npeer = 1\noperator = 1\n";

std::string cube(const std::string& lines) {
  return "[[object]]\nname = \"cube\"\nbox = \"40 40 40 mm\"\n" + lines;
}
SceneFile parsed(const std::string& text) { return parse_scene_file(text, "x.toml"); }

TEST(BodyKeys, GiveMassFrictionAndRestitution) {
  const SceneFile file =
      parsed("[scene]\ngravity = \"0 0 -1.62 m/s2\"\n" +
             cube("mass = \"50 g\"\nbody_friction = 0.7\nrestitution = 0.2\n") + kHand);
  const haptics::Matter& matter = file.scene.objects.at(0).matter;
  EXPECT_NEAR(matter.mass, 0.05, 1e-15);
  EXPECT_EQ(matter.friction, 0.7);
  EXPECT_EQ(matter.restitution, 0.2);
  EXPECT_EQ(file.scene.gravity.z(), -1.62);
  const haptics::Matter absent = parsed(cube("") + kHand).scene.objects.at(0).matter, standard;
  EXPECT_EQ(absent.mass, 0.0) << "it stands still";
  EXPECT_EQ(absent.friction, standard.friction);
  EXPECT_EQ(absent.restitution, standard.restitution);
}

TEST(BodyKeys, RefuseAPlaneWithMass) {
  EXPECT_THAT(refusal("[[object]]\nname = \"a\"\nplane = [0, 0, 1]\nmass = \"1 kg\"\n" +
                      std::string(kHand)),
              HasSubstr("a plane is infinite and cannot move"));
}

TEST(BodyKeys, GiveSolidsAMass) {
  const SceneFile file = parsed(
      "[[object]]\nname = \"a\"\ncylinder = {radius = \"1 cm\", height = \"4 cm\"}\n"
      "mass = \"1 kg\"\n" +
      std::string(kHand));
  EXPECT_EQ(file.scene.objects.at(0).matter.mass, 1.0);
}

TEST(BodyKeys, GiveTheGrabSpringsOfObjectsAndHands) {
  const SceneFile file =
      parsed(cube("mass = \"50 g\"\ngrab = {stiffness = \"200 N/m\", most = \"2 N\"}\n") +
             "[hand]\ngrab_stiffness = \"150 N/m\"\ngrab_viscosity = \"0.5 N s/m\"\ngrab_most = "
             "\"4 N\"\n" +
             "[[operator]]\nsweep = {from = \"0 0 0 m\", to = \"1 0 0 m\", grab = true}\n"
             "[[device]]\npeer = 1\noperator = 1\ngrab_button = 3\n");
  const haptics::GrabSpring& grab = file.scene.objects.at(0).grab;
  EXPECT_EQ(grab.stiffness, 200.0);
  EXPECT_EQ(grab.most, 2.0);
  EXPECT_EQ(file.hand.grab.stiffness, 150.0);
  EXPECT_EQ(file.hand.grab.viscosity, 0.5);
  EXPECT_EQ(file.hand.grab.most, 4.0);
  EXPECT_EQ(file.devices.at(0).grab_button, 3U);
  EXPECT_TRUE(file.operators.at(0).grabs);
  EXPECT_EQ(parsed(cube("mass = \"50 g\"\n") + kHand).hand.grab.stiffness, 0.0);
  EXPECT_THAT(refusal(cube("grab = {stiffness = \"200 N/m\"}\n") + kHand),
              HasSubstr("only a body sticks to a hand"));
  EXPECT_THAT(refusal(cube("mass = \"50 g\"\ngrab = {most = \"2 N\"}\n") + kHand),
              HasSubstr("needs a stiffness to hold"));
}

TEST(BodyKeys, NeedDevicesOfPeerOneAtOneRate) {
  const std::string body = cube("mass = \"50 g\"\n");
  EXPECT_THAT(refusal(body), HasSubstr("add a [[device]] of peer 1"));
  EXPECT_THAT(refusal(body + "[[operator]]\npassive = true\n[[device]]\npeer = 2\noperator = 1\n"),
              HasSubstr("add a [[device]] of peer 1"));
  EXPECT_EQ(refusal(body + kHand + "[[device]]\npeer = 2\noperator = 1\nrate = \"2 kHz\"\n"), "");
  EXPECT_THAT(refusal(body + kHand + "[[device]]\npeer = 1\noperator = 1\nrate = \"2 kHz\"\n"),
              HasSubstr("give all devices of a peer the same rate"));
  EXPECT_EQ(refusal(body + kHand), "");
}

TEST(BodyKeys, AreInTheHashOfAScene) {
  const auto hash = [](const std::string& lines) { return parsed(cube(lines) + kHand).hash; };
  const std::uint64_t still = hash("");
  EXPECT_EQ(hash("body_friction = 0.3\n"), still) << "without a body nothing comes of it";
  const std::uint64_t moving = hash("mass = \"50 g\"\n");
  EXPECT_NE(moving, still);
  EXPECT_NE(hash("mass = \"60 g\"\n"), moving);
  EXPECT_NE(hash("mass = \"50 g\"\nrestitution = 0.5\n"), moving);
}

}  // namespace
}  // namespace reckon::peer

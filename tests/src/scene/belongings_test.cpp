// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/belongings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;

SceneFile scene(const std::string& text, const std::filesystem::path& folder = ".") {
  return parse_scene_file(text, "x.toml", folder);
}

std::vector<std::uint32_t> operators_of(const SceneFile& file, std::uint32_t peer) {
  std::vector<std::uint32_t> numbers;
  for (const DeviceConfig& device : devices_of(file, peer)) {
    EXPECT_EQ(device.peer, peer);
    numbers.push_back(device.operator_number);
  }
  return numbers;
}

const std::string kTwoOperators = "[[operator]]\npassive = true\n[[operator]]\npassive = true\n";

TEST(DevicesOf, AreOneEachWhereTheSceneNamesNone) {
  const SceneFile file = scene(kTwoOperators);
  EXPECT_THAT(operators_of(file, 1), ElementsAre(1));
  EXPECT_THAT(operators_of(file, 2), ElementsAre(2));
  EXPECT_THAT(operators_of(file, 3), ElementsAre(3)) << "the first again, aside";
  EXPECT_THAT(operators_of(scene(""), 1), ElementsAre(1));
}

TEST(DevicesOf, AreThePeersOwnWhereAnyAreNamed) {
  const SceneFile file =
      scene(kTwoOperators + "[[device]]\npeer = 2\noperator = 2\n[[device]]\npeer = 2\n");
  EXPECT_THAT(operators_of(file, 1), IsEmpty());
  EXPECT_THAT(operators_of(file, 2), ElementsAre(2, 1)) << "in the file's order";
  EXPECT_THAT(operators_of(file, 3), IsEmpty());
}

TEST(DevicesOf, AreNoneForEntityOwnersWithoutOperator) {
  EXPECT_THAT(operators_of(scene("[[entity]]\n"), 1), IsEmpty());
  EXPECT_THAT(operators_of(scene("[[entity]]\n"), 2), ElementsAre(2));
  const SceneFile file = scene(kTwoOperators + "[[entity]]\npeer = 2\n[[entity]]\npeer = 3\n");
  EXPECT_THAT(operators_of(file, 2), ElementsAre(2)) << "operator 2 is its own";
  EXPECT_THAT(operators_of(file, 3), IsEmpty());
}

TEST(EntitiesOf, AreThePeersOwnInFileOrder) {
  const SceneFile file = scene(
      "[[entity]]\nmarking = \"A\"\n[[entity]]\npeer = 2\nmarking = \"B\"\n[[entity]]\n"
      "marking = \"C\"\n");
  ASSERT_EQ(entities_of(file, 1).size(), 2u);
  EXPECT_EQ(entities_of(file, 1)[1].marking, "C");
  EXPECT_EQ(entities_of(file, 2).at(0).marking, "B");
  EXPECT_THAT(entities_of(file, 3), IsEmpty());
}

TEST(PeersOf, AreAsManyAsHaveSomething) {
  EXPECT_EQ(peers_of(scene("")), 1u);
  EXPECT_EQ(peers_of(scene(kTwoOperators)), 2u);
  EXPECT_EQ(peers_of(scene(kTwoOperators + "[[device]]\n")), 1u)
      << "operators are held by devices then";
  EXPECT_EQ(peers_of(scene(kTwoOperators + "[[entity]]\npeer = 5\n")), 5u);
  EXPECT_EQ(peers_of(scene(kTwoOperators + "[[device]]\npeer = 7\n")), 7u);
}

TEST(TracksOf, MoveEntitiesByTheirTables) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("t.csv")) << "t_s,px_m,py_m,pz_m\n0,0,0,0\n1,10,0,0\n2,20,0,0\n";
  const std::string with = "[[entity]]\ntrack = \"t.csv\"\n";
  const SceneFile file = scene(
      with + "position = [0, 5, 0]\n" + with + "speed = 2\n" + with + "heading = \"0 deg\"\n" +
          with + "force_model = { kind = \"sphere\" }\n" + "[[entity]]\nposition = [7, 7, 7]\n",
      folder.file("."));
  auto tracks = tracks_of(file.entities);
  ASSERT_EQ(tracks.size(), 5u);
  EXPECT_LE((tracks[0].at(0.5).position - Vector3d(5, 5, 0)).norm(), 1e-12);
  EXPECT_LE((tracks[1].at(0.25).position - Vector3d(5, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(tracks[4].at(0.5).position, Vector3d(7, 7, 7));
  EXPECT_EQ(tracks[0].curve(), tracks[1].curve()) << "one reading serves both";
  const Vector3d east = Vector3d::UnitX(), north = Vector3d::UnitY();
  const auto nose = [&](std::size_t i) -> Vector3d { return tracks[i].at(0.5).orientation * east; };
  EXPECT_LE((nose(0) - east).norm(), 1e-12) << "along its way";
  EXPECT_LE((nose(2) - north).norm(), 1e-12) << "as its heading says";
  EXPECT_LE((nose(3) - north).norm(), 1e-12) << "hands feel it: it does not turn by itself";
}

}  // namespace
}  // namespace reckon::peer

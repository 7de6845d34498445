// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// scenes/exercise.toml: each peer shows what is near its entities, and the cell of a beacon, where
// it is.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>

#include "reckon/tests/support/places.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::tools::exercise_scene_test {
namespace {

using namespace std::chrono_literals;

// [m] A copy is off by its threshold of 1 m, and by up to half of it more while it converges after
// an update; 1.51 m in ten minutes.
constexpr double kMost = 1.6;

peer::SceneFile shipped() {
  return peer::load_scene_file(reckon::test::source_dir() + "/scenes/exercise.toml");
}

/// The largest error [m] of a shown entity of three peers.
double worst_error(const peer::SceneFile& scene, std::chrono::seconds length) {
  ExerciseOptions options;
  options.peers = 3;
  options.simulated_time = true;
  options.epoch = 1;
  Exercise exercise(scene, options);
  exercise.run(length);
  const peer::Spread error = exercise.measurement().pose_error();
  EXPECT_GT(error.count, 0U);
  return error.max;
}

TEST(ExerciseScene, ShowsEntitiesWhereTheyAre) {
  EXPECT_EQ(shipped().entities.size(), 40U);
  EXPECT_LT(worst_error(shipped(), 300s), kMost);
}

// Small cells, into and out of which everything moves; and nothing near but the beacon.
TEST(ExerciseScene, ShowsEntitiesThatChangeCellsWhereTheyAre) {
  for (const auto& [cell, radius] : {std::pair{150.0, 300.0}, {400.0, 100.0}}) {
    peer::SceneFile scene = shipped();
    scene.aoim.cell = cell;
    scene.aoim.radius = radius;
    EXPECT_LT(worst_error(scene, 120s), kMost) << cell << " m, " << radius << " m";
  }
}

TEST(ExerciseScene, ShowsEntitiesWhereTheyAreWithoutLeaders) {
  peer::SceneFile scene = shipped();
  scene.aoim.leaders = scene.aoim.hand_out = false;
  scene.aoim.follow.clear();
  for (peer::EntityConfig& entity : scene.entities) entity.beacon.clear();
  scene.aoim.cell = 150.0;
  scene.aoim.radius = 300.0;
  EXPECT_LT(worst_error(scene, 120s), kMost);
}

}  // namespace
}  // namespace reckon::tools::exercise_scene_test

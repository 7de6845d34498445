// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The page's statistics of the peers' network, compared with the true impairment.
#include "reckon/tools/viewer/peers_reception.hpp"

#include <gtest/gtest.h>

#include <chrono>

#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;

/// Two moving, sending hands over this network.
constexpr const char* kTwo =
    "[[operator]]\nsweep = { from = \"-300 0 0 mm\", to = \"-200 0 0 mm\", period = \"0.3 s\" }\n"
    "[[operator]]\nsweep = { from = \"300 0 0 mm\", to = \"200 0 0 mm\", period = \"0.3 s\" }\n";

/// The last sample after `span` of simulated time.
ReceptionSample reception(const peer::ImpairmentLaw& law, std::chrono::milliseconds span) {
  peer::SceneFile scene = peer::parse_scene_file(kTwo, "two.toml");
  scene.impairment.law = law;
  ExerciseOptions options;
  options.simulated_time = true;
  options.epoch = 1;
  Exercise exercise(scene, options);
  PeersReception reception;
  for (std::size_t i = 0; i < exercise.size(); ++i) reception.add(exercise.peer(i));
  ReceptionSample last;
  for (auto passed = 0ms; passed < span; passed += 50ms) {
    exercise.run(50ms);
    if (const auto sample = reception.look(exercise.elapsed())) last = *sample;
  }
  return last;
}

TEST(PeersReception, HasNoDelayOrLossOnPerfectNetworks) {
  const ReceptionSample sample = reception({}, 3s);
  EXPECT_EQ(sample.lost_share, 0.0);
  ASSERT_TRUE(sample.delay_median.has_value());
  EXPECT_LT(*sample.delay_p95, 0.002);
}

TEST(PeersReception, MeasuresDelayAndLossOfTheNetwork) {
  const ReceptionSample sample = reception(peer::delayed_by(0.1, 0.3, 0.2), 8s);
  ASSERT_TRUE(sample.lost_share && sample.delay_median && sample.delay_p95);
  EXPECT_NEAR(*sample.lost_share, 0.2, 0.1);
  EXPECT_NEAR(*sample.delay_median, 0.1, 0.02);
  EXPECT_NEAR(*sample.delay_p95, 0.127, 0.012);
}

TEST(PeersReception, IsEmptyWithoutPeersAndAtFirst) {
  PeersReception nobody;
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(nobody.look(i * 250ms).has_value());
  EXPECT_EQ(reception({}, 1000ms).time, 0ns);
  EXPECT_GT(reception({}, 1300ms).time, 0ns);
}

}  // namespace
}  // namespace reckon::tools

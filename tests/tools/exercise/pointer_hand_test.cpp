// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// scenes/pointer_hand.toml, run as `demo --simulated-time` runs it: the visitor presses the
// pointer's hand, and the pointer's hand presses the visitor.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <string>

#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tests/haptics/support/pointer_play.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::Not;

std::string file() { return reckon::test::source_dir() + "/scenes/pointer_hand.toml"; }

/// The scene in simulated time, and the latest forces of its two hands.
class PointerExercise {
 public:
  explicit PointerExercise(const peer::SceneFile& scene) : exercise_(scene, options()) {
    exercise_.on_step([this](std::size_t peer, std::size_t, const haptics::ServoSnapshot& step) {
      force_.at(peer) = step.force;
      device_.at(peer) = step.device;
      most_.at(peer) = std::max(most_.at(peer), step.force.norm());
    });
  }

  /// Holds a page's pointer at `p_S`, 60 times a second.
  void hold(const Vector3d& p_S, std::chrono::milliseconds duration) {
    for (auto t = 0ms; t < duration; t += 17ms) {
      exercise_.pointers(0)[0].lead(p_S);
      exercise_.run(17ms);
    }
  }
  [[nodiscard]] Exercise& exercise() { return exercise_; }
  [[nodiscard]] double felt(std::size_t peer) const { return force_.at(peer).norm(); }
  [[nodiscard]] double most_felt(std::size_t peer) const { return most_.at(peer); }
  [[nodiscard]] const Vector3d& at(std::size_t peer) const { return device_.at(peer); }

 private:
  static ExerciseOptions options() {
    ExerciseOptions options;
    options.simulated_time = true;
    options.epoch = 1;
    return options;
  }
  Exercise exercise_;
  std::array<Vector3d, 2> force_{Vector3d::Zero(), Vector3d::Zero()};
  std::array<Vector3d, 2> device_{Vector3d::Zero(), Vector3d::Zero()};
  std::array<double, 2> most_{};
};

peer::SceneFile scene_with(std::chrono::nanoseconds delay, double loss) {
  peer::SceneFile scene = peer::load_scene_file(file());
  scene.impairment.law.delay = delay;
  scene.impairment.law.loss = loss;
  return scene;
}

TEST(PointerHand, SceneIsGoodAndNamesItsPointer) {
  const auto check = test::run_reckon({"scene", "check", file()});
  EXPECT_EQ(check.status, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("good"));
  EXPECT_THAT(check.out, Not(HasSubstr("note:"))) << check.out;
  const auto explained = test::run_reckon({"scene", "explain", file()});
  EXPECT_THAT(
      explained.out,
      HasSubstr("a pointer, within 500 mm of the start of operator 1, with a lag of 40 ms"));
}

TEST(PointerHand, VisitorPressesItWhileItsPointerRests) {
  PointerExercise pair(scene_with(0ns, 0));
  ASSERT_EQ(pair.exercise().pointers(0).size(), 1U);
  EXPECT_TRUE(pair.exercise().pointers(1).empty());
  pair.exercise().run(3s);
  constexpr double kSeries = 1 / (2 / 300.0 + 1 / 500.0);
  for (const std::size_t peer : {0U, 1U}) {
    EXPECT_NEAR(pair.most_felt(peer), 0.0174 * kSeries, 0.03) << peer;
  }
  EXPECT_GE(pair.exercise().measurement().energy_min(), -1e-9);
}

// 12 mm beyond the first touch: 1.38 N by springs in series.
TEST(PointerHand, BothHandsFeelTheSameOverAnyNetwork) {
  for (const bool bad : {false, true}) {
    peer::SceneFile scene = scene_with(bad ? 100ms : 0ms, bad ? 0.2 : 0.0);
    scene.operators[1].to = scene.operators[1].from;  // it rests there
    PointerExercise pair(scene);
    pair.exercise().run(500ms);
    pair.hold({0.092, 0, 0.09}, 7500ms);
    EXPECT_GT(pair.felt(0), 1.0) << bad;
    EXPECT_NEAR(pair.felt(1), 0.012 / (2 / 300.0 + 1 / 500.0), 0.03) << bad;
    EXPECT_NEAR(pair.felt(0), pair.felt(1), 0.05 * pair.felt(1)) << bad;
    EXPECT_TRUE(pair.exercise().pointers(0)[0].inbox->is_held());
    EXPECT_GE(pair.exercise().measurement().energy_min(), -1e-9) << bad;
    EXPECT_EQ(pair.exercise().measurement().trips(), 0U) << bad;

    pair.exercise().pointers(0)[0].release();
    pair.exercise().run(1500ms);
    EXPECT_FALSE(pair.exercise().pointers(0)[0].inbox->is_held());
    EXPECT_LT(pair.felt(0), 0.02) << bad;
    EXPECT_LT(pair.felt(1), 0.02) << bad;
  }
}

// The servos' own test has more seeds: tests/haptics/devices/pointer_pair_test.cpp.
TEST(PointerHand, WholePeersMakeNoEnergyForAnyPointer) {
  const unsigned seeds = test::tries(24U, 90U);
  double least = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const bool bad = seed % 2 == 0;
    PointerExercise pair(scene_with(bad ? 100ms : 0ms, bad ? 0.2 : 0.0));
    haptics::PointerPlay play(seed);
    const PointerHand& hand = pair.exercise().pointers(0)[0];
    for (int ms = 0; ms < 2000; ++ms) {
      play.at(ms, [&](const haptics::PointerSample& sample) {
        hand.inbox->put({sample.position + Vector3d(0, 0, 0.09), sample.held});
      });
      pair.exercise().run(1ms);
    }
    const DemoMeasurement& measured = pair.exercise().measurement();
    ASSERT_GE(measured.energy_min(), -1e-9) << "seed " << seed;
    ASSERT_EQ(measured.trips(), 0U) << "seed " << seed;
    ASSERT_LE(std::max(pair.most_felt(0), pair.most_felt(1)), 10.0 + 1e-9) << "seed " << seed;
    for (const std::size_t peer : {0U, 1U}) {
      ASSERT_EQ(pair.exercise().view(peer).entities, 1U) << "seed " << seed << ", peer " << peer;
    }
    least = std::min(least, measured.energy_min());
  }
  std::printf("%u seeds: least energy at a port or in sum %.2g J\n", seeds, least);
}

TEST(PointerHand, FollowsThePointerForAnyDevicePose) {
  peer::SceneFile scene = scene_with(0ns, 0);
  scene.devices[0].position = {0.1, -0.2, 0.3};
  scene.devices[0].orientation = peer::device_orientation_of({0.5, 0.3, -0.7});
  SimulatedHands hands = make_simulated_hands(scene, 1);
  ASSERT_EQ(hands.pointers.size(), 1U);
  const Vector3d wanted(0.05, -0.1, 0.2);
  for (auto now = 0ms; now < 1s; now += 1ms) {
    hands.pointers[0].lead(wanted);
    static_cast<void>(hands.devices[0]->read(now));
  }
  const Vector3d p_S =
      scene.devices[0].position + scene.devices[0].orientation * hands.devices[0]->position();
  EXPECT_LE((p_S - wanted).norm(), 1e-5);
}

TEST(PointerHand, ScriptReplacesThePointer) {
  const peer::SceneFile scene = scene_with(0ns, 0);
  const SimulatedHands hands =
      make_simulated_hands(scene, 1, [](double) { return haptics::HandTarget{}; });
  EXPECT_TRUE(hands.pointers.empty());
  EXPECT_EQ(hands.devices.size(), 1U);
}

}  // namespace
}  // namespace reckon::tools

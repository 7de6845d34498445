// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The demo's course in simulated time, and the forces of its hands without the gate.
#include "reckon/tools/exercise/hand_twins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "reckon/tests/support/places.hpp"
#include "reckon/tools/verbs/demo_page.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

peer::SceneFile scene_of(const std::string& name, std::size_t peers) {
  peer::SceneFile scene = peer::load_scene_file(reckon::test::source_dir() + "/scenes/" + name);
  let_pages_move_hands(scene, peers);
  return scene;
}

peer::ImpairmentLaw network(nanoseconds delay, double loss) {
  peer::ImpairmentLaw law;
  law.delay = delay;
  law.loss = loss;
  return law;
}

ExerciseOptions options(std::size_t peers) {
  ExerciseOptions options;
  options.peers = peers;
  options.simulated_time = true;
  options.epoch = 1;
  options.trace_contacts = true;
  return options;
}

/// Extremes over a time span.
struct Seen {
  double most_felt = 0, most_twin = 0;  // [N]
  double most_apart = 0;                // [N], between felt and twin
  double felt_step = 0, twin_step = 0;  // [N], greatest change within 10 ms
  double least_twins = 0;               // [J], of all twins together
  std::size_t feeling = 0, steps = 0;
};

/// A scene as `demo --view` runs it, but in simulated time.
class TwinnedExercise {
 public:
  explicit TwinnedExercise(const peer::SceneFile& scene, std::size_t peers = 2)
      : exercise_(scene, options(peers)), twins_(scene, exercise_) {
    exercise_.on_step(
        [this](std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step) {
          twins_.take(peer, device, step);
          least_energy_ = std::min(least_energy_, step.port_energy + step.loan);
          // Twins of earlier hands wait for the last one.
          if (peer + 1 == exercise_.size()) note(peer, device, step);
        });
  }

  Seen run(nanoseconds duration) {
    seen_ = Seen{};
    exercise_.run(duration);
    return seen_;
  }
  [[nodiscard]] Exercise& exercise() { return exercise_; }
  [[nodiscard]] HandTwins& twins() { return twins_; }
  /// Newest step of the last hand.
  [[nodiscard]] const haptics::ServoSnapshot& at() const { return at_; }
  [[nodiscard]] double least_energy() const { return least_energy_; }

 private:
  void note(std::size_t peer, std::size_t device, const haptics::ServoSnapshot& step) {
    const haptics::UngatedTwin& twin = *twins_.find(peer, device);
    at_ = step;
    const double felt = step.force.norm(), without = twin.force().norm();
    seen_.most_felt = std::max(seen_.most_felt, felt);
    seen_.most_twin = std::max(seen_.most_twin, without);
    seen_.most_apart = std::max(seen_.most_apart, std::abs(without - felt));
    if (step.step % 10 == 0) {
      seen_.felt_step = std::max(seen_.felt_step, std::abs(felt - felt_));
      seen_.twin_step = std::max(seen_.twin_step, std::abs(without - twin_));
      felt_ = felt;
      twin_ = without;
    }
    seen_.least_twins = std::min(seen_.least_twins, twins_.energy());
    seen_.feeling += twin.feels() ? 1 : 0;
    ++seen_.steps;
  }

  Exercise exercise_;
  HandTwins twins_;
  Seen seen_;
  haptics::ServoSnapshot at_;
  double felt_ = 0, twin_ = 0, least_energy_ = 0;
};

TEST(HandTwins, LieOnTheFeltForceWithoutDelay) {
  TwinnedExercise pair(scene_of("meeting.toml", 2));
  pair.run(2s);  // the hands meet
  const Seen pressed = pair.run(4s);
  const Seen all = pair.run(19s);  // part, stroke the stone, meet again
  std::printf("pressed %.2f N, twin %.3f N apart; all the course %.3f N; together %.1f mJ\n",
              pressed.most_felt, pressed.most_apart, all.most_apart, 1e3 * all.least_twins);
  EXPECT_GT(pressed.most_felt, 1.9);
  EXPECT_LT(pressed.most_apart, 0.15);
  EXPECT_LT(pressed.twin_step, 0.1);
  EXPECT_LT(all.most_apart, 0.6);  // a meeting may be felt some ms sooner or later
  EXPECT_GE(std::min(pressed.least_twins, all.least_twins), -1e-4);
  EXPECT_EQ(pair.twins().resets(), 0U);
  EXPECT_EQ(all.feeling, all.steps);
}

TEST(HandTwins, OscillateOverADelayWhileHandsStayCalm) {
  for (const nanoseconds delay : {150ms, 300ms}) {
    peer::SceneFile scene = scene_of("meeting.toml", 2);
    scene.impairment.law = network(delay, 0.2);
    TwinnedExercise pair(scene);
    pair.run(2s);
    const Seen pressed = pair.run(4s);
    std::printf(
        "%lld ms: felt up to %.2f N, by %.2f N within 10 ms; twin up to %.2f N, by %.2f N; "
        "together %.0f mJ, lost %d times\n",
        static_cast<long long>(delay / 1ms), pressed.most_felt, pressed.felt_step,
        pressed.most_twin, pressed.twin_step, 1e3 * pressed.least_twins,
        static_cast<int>(pair.twins().resets()));
    if (delay == 150ms) {  // at twice the delay single updates are felt
      EXPECT_LT(pressed.most_felt, 3.5);
      EXPECT_LT(pressed.felt_step, 0.2);
    }
    EXPECT_GT(pressed.most_twin, 6.0);
    EXPECT_GT(pressed.twin_step, 4.0);
    EXPECT_LT(pressed.least_twins, -0.1);
    EXPECT_GT(pair.twins().resets(), 0U);
    EXPECT_GT(pressed.feeling, pressed.steps / 3);
    EXPECT_GE(pair.least_energy(), -1e-9);
    EXPECT_GE(pair.exercise().measurement().energy_min(), -1e-9);
  }
}

TEST(HandTwins, FollowChangesOfTheNetwork) {
  TwinnedExercise pair(scene_of("meeting.toml", 2));
  pair.run(3s);
  EXPECT_EQ(pair.twins().resets(), 0U);
  pair.twins().change_impairment(network(150ms, 0.2));
  EXPECT_GT(pair.run(2s).twin_step, 4.0);
  pair.twins().change_impairment({});
  pair.run(1500ms);
  EXPECT_LT(pair.run(500ms).twin_step, 0.2);
}

TEST(HandTwins, GoTheWayOfTheirHandsPointer) {
  TwinnedExercise one(scene_of("meeting.toml", 1), 1);
  const PointerHand pointer = one.twins().followed(0, one.exercise().pointers(0)[0]);
  EXPECT_NE(pointer.recorder, nullptr);
  const Vector3d start(-0.05, 0, 0.25);
  double most = 0;
  for (int i = 0; i < 200; ++i) {
    const double angle = 0.05 * i;
    if (i % 50 < 40) {
      pointer.lead(start + 0.08 * Vector3d(std::sin(angle), std::cos(angle), 0));
    } else {
      pointer.release();
    }
    one.run(17ms);
    const haptics::HandMotion twin = one.twins().find(0, 0)->motion();
    EXPECT_EQ(twin.time, one.at().time);
    most = std::max(most, (twin.position - one.at().device).norm());
  }
  std::printf("%.2g m apart\n", most);
  EXPECT_LT(most, 1e-9);
}

TEST(HandTwins, SurviveAnyPointerInput) {
  TwinnedExercise pair(scene_of("meeting.toml", 2));
  const PointerHand pointer = pair.twins().followed(0, pair.exercise().pointers(0)[0]);
  using Limits = std::numeric_limits<double>;
  const std::array<Vector3d, 6> hostile{
      Vector3d(Limits::quiet_NaN(), 0, 0), Vector3d(1e300, 0, 0),  Vector3d(-50, 50, 50),
      Vector3d(0, Limits::infinity(), 0),  Vector3d(50, -50, -50), Vector3d(0, 0, 0)};
  for (std::size_t i = 0; i < 300; ++i) {
    pointer.lead(hostile.at(i % hostile.size()));
    const Seen seen = pair.run(17ms);
    ASSERT_TRUE(std::isfinite(seen.most_twin));
    ASSERT_LE(seen.most_twin, 10.0);
    ASSERT_TRUE(std::isfinite(pair.twins().energy()));
  }
}

TEST(HandTwins, BelongToTheFirstPointerHandsOnly) {
  peer::SceneFile scene = scene_of("meeting.toml", 10);
  scene.devices[1].source = peer::DeviceSource::simulated;
  Exercise exercise(scene, options(10));
  HandTwins twins(scene, exercise);
  EXPECT_EQ(twins.find(1, 0), nullptr);
  EXPECT_NE(twins.find(HandTwins::kMost, 0), nullptr);
  EXPECT_EQ(twins.find(HandTwins::kMost + 1, 0), nullptr);
  twins.take(1, 0, {});
}

TEST(HandTwins, DoNotWaitForASilentHand) {
  peer::SceneFile scene = scene_of("meeting.toml", 2);
  Exercise exercise(scene, options(2));
  HandTwins twins(scene, exercise);
  haptics::ServoSnapshot step;
  for (std::size_t i = 1; i <= HandTwins::kMostWaiting; ++i) {
    step.time = 1s + i * 1ms;
    twins.take(0, 0, step);
  }
  EXPECT_FALSE(twins.find(0, 0)->feels());
  step.time += 1ms;
  twins.take(0, 0, step);
  EXPECT_EQ(twins.find(0, 0)->motion().time, 1s + 1ms);
}

}  // namespace
}  // namespace reckon::tools

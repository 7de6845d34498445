// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/stop_control.hpp"

#include <gmock/gmock.h>

#include <csignal>

#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace std::chrono_literals;

TEST(StopControl, Sigusr1PressesAndReleasesItWithAReport) {
  StopControl control;
  EXPECT_THAT(control.take_notices(), IsEmpty());
  ASSERT_EQ(std::raise(SIGUSR1), 0);
  EXPECT_TRUE(control.stop().is_pressed());
  EXPECT_THAT(control.take_notices(), ElementsAre(HasSubstr("all forces are stopped by SIGUSR1")));
  EXPECT_THAT(control.take_notices(), IsEmpty()) << "said once";
  ASSERT_EQ(std::raise(SIGUSR1), 0);
  EXPECT_FALSE(control.stop().is_pressed());
  EXPECT_THAT(control.take_notices(), ElementsAre(HasSubstr("forces are restored")));
}

TEST(StopControl, ItsKeyDoesNotReleaseInHaste) {
  StopControl control;
  control.press_key(10s);
  for (const auto later : {1ms, 100ms, 499ms}) control.press_key(10s + later);
  EXPECT_TRUE(control.stop().is_pressed());
  EXPECT_THAT(control.take_notices(), ElementsAre(HasSubstr("the key s")));
  control.press_key(10s + 500ms);
  EXPECT_FALSE(control.stop().is_pressed());
}

TEST(StopControl, ASignalAfterItsEndEndsNoProgram) {
  { const StopControl control; }
  ASSERT_EQ(std::raise(SIGUSR1), 0);
  StopControl next;
  ASSERT_EQ(std::raise(SIGUSR1), 0);
  EXPECT_TRUE(next.stop().is_pressed()) << "and the next one has it again";
}

// Two peers whose three hands press a floor.
TEST(StopControl, RemovesTheForceOfAllHands) {
  StopControl control;
  const auto scene = peer::parse_scene_file(
      "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nsurface = { stiffness = 500 }\n"
      "[[operator]]\npassive = true\nposition = \"0 0 -5 mm\"\n"
      "[[operator]]\npassive = true\nposition = \"100 0 -5 mm\"\n"
      "[[operator]]\npassive = true\nposition = \"200 0 -5 mm\"\n"
      "[[device]]\npeer = 1\n[[device]]\npeer = 2\noperator = 2\n"
      "[[device]]\npeer = 2\noperator = 3\nrate = \"500 Hz\"\n",
      "x.toml");
  ExerciseOptions options;
  options.simulated_time = true;
  options.force_stop = &control.stop();
  Exercise exercise(scene, options);
  exercise.run(2s);
  for (std::size_t peer = 0; peer < 2; ++peer)
    for (const peer::HandView& hand : exercise.view(peer).own_hands())
      ASSERT_GT(hand.servo.force.norm(), 0.2);
  control.press_key(1s);
  std::size_t steps = 0;
  exercise.on_step([&](std::size_t, std::size_t, const haptics::ServoSnapshot& step) {
    ++steps;
    EXPECT_TRUE(step.stopped && step.force.isZero(0.0)) << step.step;
  });
  exercise.run(1s);
  EXPECT_EQ(steps, 2500U);
  for (std::size_t peer = 0; peer < 2; ++peer)
    for (const peer::HandView& hand : exercise.view(peer).own_hands())
      EXPECT_EQ(hand.servo.tally.stops, 1U);
  EXPECT_GE(exercise.measurement().energy_min(), -1e-9);
}

}  // namespace
}  // namespace reckon::tools

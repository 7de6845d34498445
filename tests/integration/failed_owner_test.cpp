// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner of a body fails while hands of two peers press it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reckon/tests/integration/judged_runs.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;

// The second peer owns the body, and fails while both hands press it. The first hand pushes it on,
// against its drag: as a copy, and as a body of its own peer.
TEST(TouchedBodies, ArePushedOnAfterTheirOwner) {
  OneBody body;
  body.drag = 50.0;
  body.seconds = 9.0;
  body.laws = {[](double t) {
                 const double way = 0.01 * std::max(0.0, t - 3.5);
                 return target_at(-0.1 + 0.075 * eased(t, 1.5, 2.5) + way);
               },
               [](double t) { return target_at(0.1 - 0.075 * eased(t, 0.5, 1.5)); }};
  OneBody alone = body;  // the second hand leaves it
  alone.laws[1] = [law = body.laws[1]](double t) {
    return target_at(law(t).position.x() + 0.1 * eased(t, 3.5, 4.0));
  };
  const OneBodyRun truth(alone);
  for (const double delay : {0.0003, 0.02, 0.05}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      OneBodyLine line{delay, 0.0, static_cast<std::uint64_t>(seed)};
      line.failing = 1;
      line.fails_at = 3.5;
      const OneBodyRun run(body, line);
      SCOPED_TRACE(testing::Message() << delay << ' ' << seed);
      EXPECT_EQ(run.steps()[3400].owner, 1);
      EXPECT_EQ(run.steps()[8500].owner, 0) << "adopted within 5 s";
      for (std::size_t i = 6000; i < 9000; i += 10) {
        const Vector3d off = run.steps()[i].force[0] - truth.steps()[i].force[0];
        ASSERT_LE(off.norm(), 0.02 * truth.steps()[i].force[0].norm()) << i << " ms";
      }
    }
  }
}

// The first peer owns the body, and fails. The second has no majority: nobody adopts the body until
// its user lets it go on alone.
TEST(TouchedBodies, MoveAgainAfterGoAlone) {
  OneBody body;
  body.drag = 50.0;
  body.seconds = 14.0;
  const auto pushes = [](double t) {
    return target_at(0.1 - 0.075 * eased(t, 1.5, 2.5) - 0.005 * std::max(0.0, t - 3.5));
  };
  body.laws = {
      [](double t) { return target_at(-0.1 + 0.075 * (eased(t, 0.5, 1.5) - eased(t, 3.5, 4.0))); },
      pushes};
  const OneBodyRun truth(body);
  for (const double alone_at : {7.5, 12.0}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      OneBodyLine line{0.02, 0.0, static_cast<std::uint64_t>(seed)};
      line.failing = 0;
      line.fails_at = 3.5;
      line.alone_at = alone_at;
      const OneBodyRun run(body, line);
      SCOPED_TRACE(testing::Message() << alone_at << ' ' << seed);
      const auto word = static_cast<std::size_t>(1000 * alone_at);
      EXPECT_EQ(run.steps()[word - 10].owner, -1);
      EXPECT_EQ(run.steps()[word + 1000].owner, 1);
      // A copy for 6 s after the failure, then a wall at rest.
      const std::size_t wall = alone_at < 9.5 ? 12500 : 9000;
      for (std::size_t i = 6000; i < wall; i += 10) {
        const Vector3d off = run.steps()[i].force[1] - truth.steps()[i].force[1];
        ASSERT_LE(off.norm(), 0.03 * truth.steps()[i].force[1].norm()) << i << " ms";
      }
      if (wall > word) continue;
      EXPECT_GT(run.steps()[word].force[1].x(), 4.0);
      EXPECT_LT(run.steps()[word + 1900].force[1].x(), 0.27) << "N, of the drag";
    }
  }
}

// The owner fails while hands of two peers press the body.
TEST(TouchedBodies, AreFeltAgainAfterTheirOwner) {
  const auto law = [](double side) {
    return [side](double t) {
      const double when = side < 0 ? 4.0 : 5.0;
      return target_at(side * (0.06 - 0.05 * eased(t, when, when + 0.5)), 0.01);
    };
  };
  OwnersExercise exercise(3, cubes_scene(1));
  exercise.network().impair(line_of(milliseconds(5), {}, 0.0));
  exercise.start_with_hand(0, 1, law(-1));
  exercise.start_with_hand(1, 2, law(1));
  exercise.start(2, 3);
  const auto felt = [&] {
    exercise.peer(1).views().update();
    return exercise.peer(1).views().read().servo().force.norm();
  };
  exercise.run(8000);
  ASSERT_TRUE(exercise.simulates(0, 0));
  ASSERT_GT(felt(), 1.0) << "squeezed by two peers";
  exercise.kill(0);
  const auto has_it = [&] { return exercise.simulates(1, 0); };
  double most = 0.0;
  const std::size_t took = exercise.run_until(
      [&] {
        most = std::max(most, felt());
        return has_it();
      },
      6000);
  EXPECT_LE(took, 5000u);
  EXPECT_LT(most, 6.0);
  exercise.run(1000);
  EXPECT_LT(felt(), 0.5) << "only friction is left: the hand has pushed it away";
}

}  // namespace
}  // namespace reckon::test

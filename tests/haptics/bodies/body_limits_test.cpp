// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits of a body: the work space, drag, and immovable shapes.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/bodies/contact_islands.hpp"
#include "reckon/tests/haptics/support/body_table.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics::body_limits_test {
namespace {

using Eigen::Vector3d;
using tables::kG;
using tables::Table;

// A ball between the walls of a work space: each rebound leaves the square of the restitution of
// each axis, and no body is ever outside.
TEST(BodyWorld, KeepsBodiesWithinTheWorkSpace) {
  for (const double e : {1.0, 0.9}) {
    for (const double speed : {0.5137, 20.31, 150.7}) {
      Table table;
      table.without_gravity();
      table.within({0.4, 0.3, 0.5}, e);
      table.ball(0.02, Vector3d::Zero(), {0.1});
      BodyWorld& world = table.begin();
      world.push(0, Vector3d::Zero(), 0.1 * speed / 1e-3 * Vector3d::UnitX());
      table.run(0.001);
      const double begin = world.energy();
      int rebounds = 0;
      for (int i = 0; i < 2000; ++i) {
        const double before = table.state().velocity.x(), at = table.state().position.x();
        table.run(0.001);
        const Vector3d& p = table.state().position;
        ASSERT_LE(std::abs(p.x()), 0.18 + 1e-15) << speed;
        // Walls reached in this step, from its former position.
        double v = before, x = at, left = 1e-3;
        while (v != 0 && (v > 0 ? 0.18 - x : x + 0.18) < std::abs(v) * left) {
          left -= (v > 0 ? 0.18 - x : x + 0.18) / std::abs(v);
          x = v > 0 ? 0.18 : -0.18;
          v *= -e;
          ++rebounds;
        }
        ASSERT_NEAR(world.energy() / (begin * std::pow(e, 2 * rebounds)), 1.0, 1e-9) << rebounds;
      }
      EXPECT_GT(rebounds, 1);
    }
  }
}

TEST(BodyWorld, HoldsTumblingBoxesInTheWorkSpace) {
  Table table;
  table.within({0.4, 0.3, 0.5}, 0.7);
  for (int i = 0; i < 8; ++i)
    table.box(0.04, Vector3d(0.05 * (i % 4) - 0.08, 0.06 * (i / 4), 0), {0.1});
  BodyWorld& world = table.begin();
  for (std::size_t i = 0; i < 8; ++i)
    world.push(i, table.state(i).position + Vector3d(0, 0.01, 0.02),
               Vector3d(40.0 - 9.0 * static_cast<double>(i), 30, 50));
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5000; ++i) {
    table.run(0.001);
    ASSERT_LE(world.energy(), last + 1e-3) << i;
    last = std::min(last, world.energy());
    for (std::size_t k = 0; k < 8; ++k)
      ASSERT_TRUE((table.state(k).position.array().abs() <= Eigen::Array3d(0.2, 0.15, 0.25)).all());
  }
}

TEST(BodyWorld, SlowsABodyByItsDrag) {
  Table table;
  table.ball(0.02, {0, 0, 1}, {0.1, 0.5, 0.0, 0.05});
  table.begin();
  table.run(1.0);
  const double c = 0.5, t = 1.0;
  EXPECT_NEAR(table.state().velocity.z(), -kG / c * (1 - std::exp(-c * t)), 1e-9);
  EXPECT_NEAR(table.state().position.z(), 1 - kG / c * (t - (1 - std::exp(-c * t)) / c), 1e-9);
}

TEST(BodyWorld, RefusesImmovableShapesByName) {
  Table plane;
  plane.floor({1.0});
  EXPECT_THROW(plane.begin(), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics::body_limits_test

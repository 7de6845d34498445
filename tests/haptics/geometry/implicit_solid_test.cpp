// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The surface contact point (SCP) on implicit surfaces. RECKON_SOAK=1 pokes a million times.
#include "reckon/haptics/geometry/implicit_solid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <vector>

#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/implicit_solids.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using SolidPointer = std::shared_ptr<const ImplicitSolid>;

constexpr double kTight = 1e-9;  // [m]

bool soak() { return std::getenv("RECKON_SOAK") != nullptr; }

Vector3d random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> x(-reach, reach);
  return {x(random), x(random), x(random)};
}

template <class ShapeOfIt>
SolidPointer solid(const ShapeOfIt& shape) {
  return std::make_shared<const ImplicitSolid>(shape);
}

struct Pokes {
  long count = 0, touching = 0, hovering = 0, raised = 0;
  double deepest = 0.0, highest = 0.0;  // [m], of the SCP's f - radius
};

// From outside into the solid, through it, along it and out, in leaps of all lengths.
void poke(const ImplicitSolid& object, const ContactShape& shape, double radius, int rounds,
          Pokes& pokes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  FrictionCone friction(0.5, 0.35);
  const double reach = 0.09 + 2.0 * radius;
  for (int i = 0; i < rounds; ++i) {
    Vector3d device = 2.5 * reach * random_point(random, 1.0).normalized();
    if (object.contains(device, radius + kTight)) continue;
    SurfaceContactPoint point(radius);
    point.reset(shape, device);
    for (int k = 0; k < 10; ++k) {
      const double leap = k % 2 == 0 ? 1.0 : std::pow(10.0, -3.0 * share(random));
      device += leap * (random_point(random, 0.6 * reach) - device);
      const double before = (device - point.scp()).norm();
      point.update(shape, device, i % 2 == 0 ? nullptr : &friction);
      const double above = object.sample(point.scp()).value - radius;
      ++pokes.count;
      pokes.deepest = std::max(pokes.deepest, -above);
      if ((device - point.scp()).norm() > before * (1.0 + 1e-15)) ++pokes.raised;
      if (!point.in_contact()) {
        ASSERT_EQ(point.scp(), device);
        continue;
      }
      ++pokes.touching;
      pokes.highest = std::max(pokes.highest, above);
      if (above >= kTight) ++pokes.hovering;
    }
  }
}

TEST(ImplicitSolid, NoPokeBringsTheContactPointInsideNorAwayFromTheSurface) {
  Pokes all;
  for (const test::NamedSolid& named : test::implicit_solids()) {
    for (const double radius : {0.0, 5e-3}) {
      Pokes pokes;
      poke(*named.solid, named.solid, radius, soak() ? 4500 : 60, pokes);
      const std::string told = named.name + ", radius " + std::to_string(radius);
      EXPECT_LT(pokes.deepest, kTight) << told;
      EXPECT_EQ(pokes.hovering, 0) << told << ", highest " << pokes.highest;
      EXPECT_EQ(pokes.raised, 0) << told;
      EXPECT_GT(pokes.touching, pokes.count / 10) << told;
      all.count += pokes.count;
      all.touching += pokes.touching;
      all.deepest = std::max(all.deepest, pokes.deepest);
      all.highest = std::max(all.highest, pokes.highest);
    }
  }
  std::printf("%ld pokes, %ld touching: deepest %.2g m, highest %.2g m\n", all.count, all.touching,
              all.deepest, all.highest);
}

}  // namespace
}  // namespace reckon::haptics

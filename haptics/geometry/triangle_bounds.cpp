// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/triangle_bounds.hpp"

#include <algorithm>
#include <array>

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// [sizes], greatest error of a normal: a sliver's normal may be worse, and bounds nothing.
constexpr double kFlattest = 1e-7;

}  // namespace

// The offsets hold for all three corners, whatever the rounding of the directions. The directions
// across the sides are at right angles to the normal, so that the squares of both distances add up.
TriangleBounds::Ways TriangleBounds::ways_of(const Triangle& triangle, const Vector3d& centre,
                                             double scale) {
  const std::array<Vector3d, 3> corners{
      (triangle.a - centre) * scale, (triangle.b - centre) * scale, (triangle.c - centre) * scale};
  const auto reach = [&](const Vector3d& way) {
    return std::max({way.dot(corners[0]), way.dot(corners[1]), way.dot(corners[2])});
  };
  Ways ways{};
  const auto set = [&](std::size_t lane, const Vector3d& way, double offset) {
    ways.x[lane] = static_cast<float>(way.x());
    ways.y[lane] = static_cast<float>(way.y());
    ways.z[lane] = static_cast<float>(way.z());
    ways.offset[lane] = static_cast<float>(offset);
  };
  const Vector3d& normal = triangle.normal;
  if (reach(normal) + reach(-normal) < kFlattest) set(0, normal, reach(normal));
  for (std::size_t side = 0; side < 3; ++side) {
    const Vector3d out = (corners[(side + 1) % 3] - corners[side]).cross(normal).normalized();
    set(side + 1, out, reach(out));
  }
  return ways;
}

}  // namespace reckon::haptics

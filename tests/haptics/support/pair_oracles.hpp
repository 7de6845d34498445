// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Distances by closed forms and by comparison of all features, sharing no code with the library;
// and random shapes and placements.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "reckon/haptics/queries/query_shape.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Vector3d drawn_point(std::mt19937_64& random, double reach) {
  return {uniform(random, -reach, reach), uniform(random, -reach, reach),
          uniform(random, -reach, reach)};
}

inline Matrix3d drawn_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
  return q.normalized().toRotationMatrix();
}

inline haptics::Placement drawn_placement(std::mt19937_64& random, double reach) {
  return {drawn_point(random, reach), drawn_rotation(random)};
}

/// A mesh of that bounding-box diagonal [m].
inline haptics::QueryShape query_mesh(const MeshData& data, double size) {
  return haptics::QueryShape(
      haptics::ContactShape(std::make_shared<const haptics::SurfaceMesh>(make_mesh(data, size))));
}

template <class Shape>
haptics::QueryShape query_solid(const Shape& shape) {
  return haptics::QueryShape(
      haptics::ContactShape(std::make_shared<const haptics::ImplicitSolid>(shape)));
}

/// A box as its eight corners and three axes.
struct OracleBox {
  haptics::Placement at;
  Vector3d half;

  [[nodiscard]] std::array<Vector3d, 8> corners() const {
    std::array<Vector3d, 8> all;
    for (std::size_t i = 0; i < 8; ++i)
      all[i] =
          at.to_scene({(i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                       (i & 4) != 0 ? half.z() : -half.z()});
    return all;
  }
  [[nodiscard]] double distance_of(const Vector3d& p) const {
    return (at.to_shape(p).cwiseAbs() - half).cwiseMax(0.0).norm();
  }
};

/// The greatest gap between the projections of the corners on the fifteen axes [m].
inline double projected_gap(const OracleBox& a, const OracleBox& b) {
  const auto one = a.corners();
  const auto two = b.corners();
  double best = -std::numeric_limits<double>::infinity();
  const auto along = [&](const Vector3d& axis) {
    double low_a = 1e300, high_a = -1e300, low_b = 1e300, high_b = -1e300;
    for (std::size_t i = 0; i < 8; ++i) {
      const double p = axis.dot(one[i]), q = axis.dot(two[i]);
      low_a = std::min(low_a, p);
      high_a = std::max(high_a, p);
      low_b = std::min(low_b, q);
      high_b = std::max(high_b, q);
    }
    best = std::max({best, low_b - high_a, low_a - high_b});
  };
  for (int i = 0; i < 3; ++i) {
    along(a.at.orientation.col(i));
    along(b.at.orientation.col(i));
    for (int j = 0; j < 3; ++j) {
      const Vector3d across = a.at.orientation.col(i).cross(b.at.orientation.col(j));
      if (across.norm() > 1e-9) along(across.normalized());
    }
  }
  return best;
}

/// Distance of a point from a segment.
inline double point_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d ab = b - a;
  const double squared = ab.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(ab.dot(p - a) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * ab).norm();
}

/// Distance of two segments: of the lines, if their nearest points are inside both, otherwise of an
/// end from the other segment.
inline double segment_segment(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                              const Vector3d& d) {
  double best = std::min({point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b),
                          point_segment(d, a, b)});
  const Vector3d u = b - a, v = d - c, n = u.cross(v);
  const double area = n.squaredNorm();
  if (area > 0.0) {
    const double s = (c - a).cross(v).dot(n) / area;
    const double t = (c - a).cross(u).dot(n) / area;
    if (s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)
      best = std::min(best, std::abs((c - a).dot(n)) / std::sqrt(area));
  }
  return best;
}

/// Distance of two boxes that do not overlap: of each corner from the other box, and of each pair
/// of edges.
inline double box_box_distance(const OracleBox& a, const OracleBox& b) {
  const auto one = a.corners();
  const auto two = b.corners();
  double best = std::numeric_limits<double>::infinity();
  for (const Vector3d& p : one) best = std::min(best, b.distance_of(p));
  for (const Vector3d& p : two) best = std::min(best, a.distance_of(p));
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t bit = 1; bit < 8; bit *= 2) {
      if ((i & bit) != 0) continue;
      for (std::size_t j = 0; j < 8; ++j) {
        for (std::size_t other = 1; other < 8; other *= 2) {
          if ((j & other) != 0) continue;
          best = std::min(best, segment_segment(one[i], one[i | bit], two[j], two[j | other]));
        }
      }
    }
  }
  return best;
}

using Corners = std::array<Vector3d, 3>;

inline Vector3d normal_of(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

inline bool foot_inside(const Corners& t, const Vector3d& p) {
  const Vector3d n = normal_of(t);
  for (std::size_t i = 0; i < 3; ++i) {
    if (n.dot((t[(i + 1) % 3] - t[i]).cross(p - t[i])) < 0.0) return false;
  }
  return true;
}

/// Distance of two triangles: corners over faces, pairs of sides, and 0 if a side passes through.
inline double triangle_triangle(const Corners& a, const Corners& b) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    const Vector3d n = normal_of(other).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d &p = one[i], &q = one[(i + 1) % 3];
      const double from = n.dot(p - other[0]), to = n.dot(q - other[0]);
      if (foot_inside(other, p)) best = std::min(best, std::abs(from));
      if (from * to < 0.0 && foot_inside(other, p + from / (from - to) * (q - p))) return 0.0;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      best = std::min(best, segment_segment(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
  }
  return best;
}

inline std::vector<Corners> corners_of(const haptics::SurfaceMesh& mesh,
                                       const haptics::Placement& at) {
  std::vector<Corners> all;
  for (const haptics::Triangle& t : mesh.triangles())
    all.push_back({at.to_scene(t.a), at.to_scene(t.b), at.to_scene(t.c)});
  return all;
}

/// A ball about a triangle.
struct Ball {
  explicit Ball(const Corners& t) : middle((t[0] + t[1] + t[2]) / 3.0) {
    for (const Vector3d& corner : t) radius = std::max(radius, (corner - middle).norm());
  }
  Vector3d middle;
  double radius = 0.0;
};

/// Least distance of two triangles. Pairs with balls farther apart than the least so far are
/// skipped.
inline double all_triangles(const std::vector<Corners>& a, const std::vector<Corners>& b) {
  const std::vector<Ball> balls(b.begin(), b.end());
  double best = std::numeric_limits<double>::infinity();
  for (const Corners& one : a) {
    const Ball ball(one);
    for (std::size_t i = 0; i < b.size(); ++i) {
      if ((balls[i].middle - ball.middle).norm() - balls[i].radius - ball.radius > best) continue;
      best = std::min(best, triangle_triangle(one, b[i]));
    }
  }
  return best;
}

}  // namespace reckon::test

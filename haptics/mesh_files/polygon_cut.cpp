// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Polygons cut into triangles by clipping ears.
#include <Eigen/Geometry>
#include <algorithm>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/haptics/mesh_files/mesh_file.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Index3 = std::array<std::uint32_t, 3>;

/// Vector area of the outline, times two (Newell).
Vector3d area_vector(std::span<const Vector3d> vertices, std::span<const std::uint32_t> corners) {
  Vector3d sum = Vector3d::Zero();
  const Vector3d& origin = vertices[corners[0]];
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += (vertices[corners[i]] - origin).cross(vertices[corners[i + 1]] - origin);
  }
  return sum;
}

// Smaller polygons are as cheap as their triangles.
constexpr std::size_t kFewCorners = 64;
// Searches for ears that only appear when a corner elsewhere is gone, as rounding makes them.
constexpr int kMostSearches = 4;

/// Coordinates along two axes of the plane of a polygon, from its first corner. Counterclockwise.
std::vector<Vector2d> flattened(std::span<const Vector3d> vertices,
                                std::span<const std::uint32_t> corners) {
  const Vector3d up = area_vector(vertices, corners).stableNormalized();
  const Vector3d across = up.unitOrthogonal(), along = up.cross(across);
  const Vector3d& origin = vertices[corners[0]];
  std::vector<Vector2d> places;
  places.reserve(corners.size());
  for (const std::uint32_t corner : corners) {
    const Vector3d p = vertices[corner] - origin;
    places.emplace_back(p.dot(across), p.dot(along));
  }
  return places;
}

/// The rest of a polygon while its ears are cut off. Findings about a corner are valid until a
/// neighbour is cut.
class Outline {
 public:
  Outline(std::span<const Vector3d> vertices, std::span<const std::uint32_t> corners)
      : left_(corners.begin(), corners.end()),
        places_(flattened(vertices, corners)),
        known_(corners.size(), Known::nothing) {}

  [[nodiscard]] std::size_t size() const { return left_.size(); }

  [[nodiscard]] bool convex() const {
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (!(turn(around(i)) > 0.0)) return false;
    }
    return true;
  }

  /// Cuts the first ear off; if there is none, any corner.
  Index3 cut() {
    std::size_t best = first_ear();
    while (best == size() && searches_ < kMostSearches) {
      ++searches_;
      std::ranges::fill(known_, Known::nothing);
      best = first_ear();
    }
    if (best == size()) best = 0;
    const Index3 corners = around(best);
    const Index3 triangle{left_[corners[0]], left_[corners[1]], left_[corners[2]]};
    known_[corners[0]] = known_[corners[2]] = Known::nothing;
    const auto at = static_cast<std::ptrdiff_t>(best);
    left_.erase(left_.begin() + at);
    places_.erase(places_.begin() + at);
    known_.erase(known_.begin() + at);
    return triangle;
  }

 private:
  enum class Known : std::uint8_t { nothing, no_ear };

  /// Index of the first ear; size(): none.
  std::size_t first_ear() {
    for (std::size_t i = 0; i < size(); ++i) {
      if (known_[i] == Known::no_ear) continue;
      if (is_ear(i)) return i;
      known_[i] = Known::no_ear;
    }
    return size();
  }
  /// A corner between its neighbours.
  [[nodiscard]] Index3 around(std::size_t i) const {
    const std::size_t n = size();
    return {static_cast<std::uint32_t>((i + n - 1) % n), static_cast<std::uint32_t>(i),
            static_cast<std::uint32_t>((i + 1) % n)};
  }
  static double side(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
  }
  [[nodiscard]] double turn(const Index3& t) const {
    return side(places_[t[0]], places_[t[1]], places_[t[2]]);
  }
  [[nodiscard]] bool is_ear(std::size_t i) const {
    const Index3 t = around(i);
    if (!(turn(t) > 0.0)) return false;
    const Vector2d a = places_[t[0]], b = places_[t[1]], c = places_[t[2]];
    return std::ranges::none_of(places_, [&](const Vector2d& p) {
      return side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0 && p != a &&
             p != b && p != c;
    });
  }

  std::vector<std::uint32_t> left_;
  std::vector<Vector2d> places_;
  std::vector<Known> known_;
  int searches_ = 0;
};

}  // namespace

void cut_polygon(std::span<const Vector3d> vertices, std::span<const std::uint32_t> corners,
                 std::vector<Index3>& triangles) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) return triangles.push_back({corners[0], corners[1], corners[2]});
  Outline outline(vertices, corners);
  if (outline.convex()) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      triangles.push_back({corners[0], corners[i], corners[i + 1]});
    }
    return;
  }
  if (corners.size() > kFewCorners)
    LoadBudget::take(LoadWork::corner_pairs, corners.size() * corners.size());
  while (outline.size() >= 3) triangles.push_back(outline.cut());
}

}  // namespace reckon::haptics

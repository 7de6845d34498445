// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Polygons cut into triangles by clipping ears.
#include <Eigen/Geometry>
#include <algorithm>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/haptics/mesh_files/mesh_file.hpp"

namespace reckon::haptics {

namespace {

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

/// The rest of a polygon while its ears are cut off. An ear that is cut changes those at its two
/// neighbours.
class Outline {
 public:
  Outline(std::span<const Vector3d> vertices, std::span<const std::uint32_t> corners)
      : vertices_(vertices),
        left_(corners.begin(), corners.end()),
        up_(area_vector(vertices, corners)) {}

  [[nodiscard]] std::size_t size() const { return left_.size(); }

  [[nodiscard]] bool convex() const {
    for (std::size_t i = 0; i < left_.size(); ++i) {
      if (!(turn(ear(i)) > 0.0)) return false;
    }
    return true;
  }

  /// Cuts one ear off; if there is none, any corner.
  Index3 cut() {
    auto found = std::ranges::find(is_ear_, true);
    while (found == is_ear_.end() && searches_ < kMostSearches) {
      search();
      found = std::ranges::find(is_ear_, true);
    }
    const std::ptrdiff_t best = found == is_ear_.end() ? 0 : found - is_ear_.begin();
    const Index3 triangle = ear(static_cast<std::size_t>(best));
    left_.erase(left_.begin() + best);
    is_ear_.erase(is_ear_.begin() + best);
    const std::size_t n = left_.size(), behind = static_cast<std::size_t>(best) % n;
    for (const std::size_t i : {behind, (behind + n - 1) % n}) is_ear_[i] = is_ear(i);
    return triangle;
  }

 private:
  void search() {
    ++searches_;
    is_ear_.resize(left_.size());
    for (std::size_t i = 0; i < left_.size(); ++i) is_ear_[i] = is_ear(i);
  }
  [[nodiscard]] Index3 ear(std::size_t i) const {
    const std::size_t n = left_.size();
    return {left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]};
  }
  [[nodiscard]] double side(const Vector3d& a, const Vector3d& b, const Vector3d& p) const {
    return up_.dot((b - a).cross(p - a));
  }
  [[nodiscard]] double turn(const Index3& t) const {
    return side(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]);
  }
  [[nodiscard]] bool is_ear(std::size_t i) const {
    const Index3 t = ear(i);
    if (!(turn(t) > 0.0)) return false;
    const Vector3d &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
    for (const std::uint32_t corner : left_) {
      const Vector3d& p = vertices_[corner];
      if (p == a || p == b || p == c) continue;
      if (side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  std::span<const Vector3d> vertices_;
  std::vector<std::uint32_t> left_;
  std::vector<char> is_ear_;  // of each corner that is left, as far as it was looked at
  int searches_ = 0;
  Vector3d up_;
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

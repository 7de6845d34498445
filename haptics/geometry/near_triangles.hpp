// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The triangles near a probe, kept between sweeps. A hand that strokes a surface sweeps many times
// within the length of a few triangles, and the list replaces the search of the tree.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::haptics {

/// Filled and used by SurfaceMesh::sweep or SurfaceMesh::closest_near of one mesh. It changes the
/// cost of a query, never its result. One per probe and query, servo thread only.
class NearTriangles {
 public:
  static constexpr std::size_t kMost = 48;

  /// Discards the list and the margin of its mesh.
  void clear() noexcept {
    reach_ = -1.0;
    margin_ = 0.0;
    nearest_ = 0;
  }

 private:
  friend class SurfaceMesh;

  // Distance from the centre up to which the list is complete for a probe that stops at `stop` [m].
  [[nodiscard]] double room(double stop) const noexcept { return (1.0 - 1e-9) * (reach_ - stop); }

  // Inserts in ascending order of distance. False if the list is full.
  bool add(std::uint32_t triangle, float away) noexcept {
    if (count_ == kMost) return false;
    std::size_t place = count_++;
    while (place > 0 && away_[place - 1] > away) {
      away_[place] = away_[place - 1];
      triangles_[place] = triangles_[place - 1];
      --place;
    }
    away_[place] = away;
    triangles_[place] = triangle;
    return true;
  }

  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  // [m]
  // [m]: all triangles nearer to the centre are in the list; < 0: there is no list
  double reach_ = -1.0;
  double margin_ = 0.0;        // [m], reach of the next list beyond the probe; 0: not known yet
  std::uint32_t nearest_ = 0;  // triangle of the last nearest point
  std::size_t count_ = 0;
  std::array<float, kMost> away_{};  // [m], lower bounds of the distance from the centre
  std::array<std::uint32_t, kMost> triangles_{};
};

}  // namespace reckon::haptics

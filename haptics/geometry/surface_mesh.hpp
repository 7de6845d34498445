// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A touchable triangle surface: read from a file, repaired, and searched through a
// BoundingVolumeTree. Queries do not allocate and may run on many threads.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "reckon/haptics/geometry/bounding_volume_tree.hpp"
#include "reckon/haptics/geometry/face_names.hpp"
#include "reckon/haptics/geometry/mesh_report.hpp"
#include "reckon/haptics/geometry/near_triangles.hpp"
#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/haptics/geometry/sweep_hit.hpp"
#include "reckon/haptics/geometry/triangle_bounds.hpp"
#include "reckon/haptics/geometry/triangle_list.hpp"
#include "reckon/haptics/geometry/triangle_query.hpp"

namespace reckon::haptics {

struct TriangleSoup;

/// Nearest point of the surface.
struct ClosestPoint {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  double distance = 0.0;  ///< [m]
  std::uint32_t triangle = 0;
};

/// An open surface is a shell: both sides can be touched and nothing counts as inside.
class SurfaceMesh {
 public:
  /// Reads a file (OBJ, PLY, STL, OFF), scales and centres it according to the shape. A mesh far
  /// from its file's origin is stored relative to origin(), with every digit of the file.
  /// @throws std::runtime_error naming the file, the line if there is one, and the remedy: not
  /// readable, no usable triangle, a vertex that is not finite, a corner that does not exist.
  [[nodiscard]] static SurfaceMesh load(const MeshShape& shape);

  /// The solid of a picture, see HeightsShape. Its triangles are named "top", "side" and "bottom".
  /// @throws std::invalid_argument naming the file or the length, and the remedy
  /// @param most_pixels a picture of more is thinned, for drawing
  [[nodiscard]] static SurfaceMesh load_heights(
      const HeightsShape& shape, std::size_t most_pixels = std::numeric_limits<std::size_t>::max());

  /// Builds from indexed triangles [m]. Equal positions are welded, degenerate and repeated
  /// triangles dropped. Neighbours are turned to face the same side, and closed pieces outwards.
  /// report() counts all changes. 0.5 us a triangle.
  /// @throws std::runtime_error without a usable triangle, or on a non-finite position or bad
  /// index.
  SurfaceMesh(std::vector<Eigen::Vector3d> vertices,
              std::vector<std::array<std::uint32_t, 3>> triangles);

  [[nodiscard]] const MeshReport& report() const noexcept { return report_; }
  [[nodiscard]] const Eigen::AlignedBox3d& bounds() const noexcept { return bounds_; }
  /// Origin of this mesh's axes, in the axes of its shape [m]. Zero, unless the middle of the file
  /// is more than 100 of its sizes from the file's own origin: then that middle.
  [[nodiscard]] const Eigen::Vector3d& origin() const noexcept { return origin_; }
  /// Diagonal of the bounding box [m].
  [[nodiscard]] double size() const noexcept { return size_; }
  /// Distance of a settled SCP from the surface [m]: kRelativeClearance x size.
  [[nodiscard]] double clearance() const noexcept { return clearance_; }
  /// Radius of a point's sweep [m]: 0.99 x clearance, so that a point at the clearance slides
  /// freely.
  [[nodiscard]] double sweep_radius() const noexcept { return kStopShare * clearance_; }
  /// Triangles in the tree's order; SweepHit and ClosestPoint index them.
  [[nodiscard]] const TriangleList& triangles() const noexcept { return triangles_; }

  /// The tree that searches them; without its order().
  [[nodiscard]] const BoundingVolumeTree& tree() const noexcept { return tree_; }

  /// Names of the file's materials and groups, in the order of their first appearance.
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  /// Names of each triangle, in the tree's order; empty if the file has none.
  [[nodiscard]] const std::vector<FaceNames>& face_names() const noexcept { return face_names_; }

  /// First time at which the centre of a probe of `radius` [m] >= 0 that moves from `origin` by
  /// `step` comes within radius + sweep_radius() of the surface. A probe that is within already is
  /// stopped only if it would come closer. The padding far exceeds rounding, so that no triangle is
  /// missed. Of several met at once, the hit is the first in triangles(). @return false for a free
  /// path.
  [[nodiscard]] bool sweep(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                           double radius, SweepHit& hit) const noexcept;

  /// The same result to the last bit, faster if the sweep begins near the last one. A probe that
  /// strokes the surface tests the few triangles in `near`, its own list, instead of the tree.
  [[nodiscard]] bool sweep(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                           double radius, NearTriangles& near, SweepHit& hit) const noexcept;

  /// Nearest surface point to p within `limit` [m]. @return false if there is none.
  /// @param precision [m] >= 0: the result may be farther away than the nearest point by at most
  /// this. 0 is exact. With a higher value the search of the tree ends sooner, and from about the
  /// size of a triangle it descends only once. Sweeps have no such precision, so that it cannot let
  /// the contact point pass a surface.
  [[nodiscard]] bool closest(const Eigen::Vector3d& p, double limit, ClosestPoint& out,
                             double precision = 0.0) const noexcept;

  /// The same without a limit, with a triangle that is probably near, such as the nearest one a
  /// tick ago: its distance is the first bound of the search. Always true.
  bool closest_from(const Eigen::Vector3d& p, std::uint32_t hint, ClosestPoint& out,
                    double precision = 0.0) const noexcept;

  /// Nearest surface point to p, exact, faster if p is near the last one: `near`, its own list,
  /// keeps the triangles around it. Always true.
  bool closest_near(const Eigen::Vector3d& p, NearTriangles& near,
                    ClosestPoint& out) const noexcept;

  /// Lower bound of the distance of p from the surface [m]: its distance from the bounding box.
  [[nodiscard]] double distance_below(const Eigen::Vector3d& p) const noexcept {
    return bounds_.exteriorDistance(p);
  }

  /// Inside of a closed surface, by the vote of three rays; false for a shell.
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const noexcept;

  /// Whether the foot of p on the triangle's plane is in the triangle.
  [[nodiscard]] bool over(std::uint32_t triangle, const Eigen::Vector3d& p) const noexcept;

 private:
  struct FirstHit;
  SurfaceMesh(TriangleSoup soup, MeshReport report);
  void plant(TriangleSoup& soup);
  [[nodiscard]] bool closest_below(const Eigen::Vector3d& p, double limit, double precision,
                                   bool found, ClosestPoint& out) const noexcept;
  [[nodiscard]] bool list_near(const Eigen::Vector3d& p, double stop,
                               NearTriangles& near) const noexcept;
  [[nodiscard]] bool odd_crossings(const Eigen::Vector3d& p,
                                   const Eigen::Vector3d& ray) const noexcept;

  MeshReport report_;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds_;
  double size_ = 0.0;
  double clearance_ = 0.0;
  BoundingVolumeTree tree_;
  TriangleList triangles_;
  TriangleBounds triangle_bounds_;
  std::vector<std::string> names_;
  std::vector<FaceNames> face_names_;
};

}  // namespace reckon::haptics

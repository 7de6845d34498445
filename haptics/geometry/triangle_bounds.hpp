// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lower bounds of the distance of triangles from a point, in one cache line and a few instructions
// each. They exclude most triangles near a point before any computation in doubles.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "reckon/haptics/geometry/triangle_query.hpp"

namespace reckon::haptics {

/// Made once from a mesh's triangles; 64 bytes each. Queries do not allocate and may run on many
/// threads.
class TriangleBounds {
 public:
  /// A point in the axes and the unit of the bounds.
  struct Place {
    Eigen::Vector3f p;
    float slack;  ///< above the rounding of a distance
  };

  /// A straight path, and the distance at which a triangle counts as met.
  struct Segment {
    Eigen::Vector3f from, to;
    float reach;  ///< above the rounding of a distance
  };

  TriangleBounds() = default;

  /// @param triangles a list of Triangle  @param centre origin of the bounds  @param size [m],
  /// their unit. For single precision, both belong to a box around all triangles
  TriangleBounds(const auto& triangles, const Eigen::Vector3d& centre, double size)
      : centre_(centre), scale_(size > 0.0 ? 1.0 / size : 1.0) {
    ways_.reserve(triangles.size());
    for (const Triangle& t : triangles) ways_.push_back(ways_of(t, centre_, scale_));
  }

  /// Any finite p [m].
  [[nodiscard]] Place place(const Eigen::Vector3d& p) const noexcept;

  /// Any finite ends [m]; radius [m] >= 0.
  [[nodiscard]] Segment segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                double radius) const noexcept;

  /// Prefetches these triangles, which are examined soon.
  void fetch(std::size_t first, std::size_t count) const noexcept {
    for (std::size_t i = first; i < first + count; ++i) __builtin_prefetch(&ways_[i]);
  }

  /// True only if no point of triangle `index` is within the radius of the segment: both ends lie
  /// beyond the same side of it, or of its plane.
  [[nodiscard]] bool beside(std::size_t index, const Segment& segment) const noexcept;

  /// Lower bound of the distance of triangle `index` [m]. It is too low for a triangle that is
  /// nearest at a corner, and by up to 1e-6 sizes.
  [[nodiscard]] float distance_below(std::size_t index, const Place& place) const noexcept {
    return std::sqrt(squared_below(index, place)) * static_cast<float>(0.99999 / scale_);
  }

  /// True only if no point of triangle `index` is nearer than `limit` [m], >= 0 or infinite. May be
  /// false for a triangle beyond the limit that is nearest at a corner, or within 1e-6 sizes of it.
  [[nodiscard]] bool beyond(std::size_t index, const Place& place, double limit) const noexcept;

 private:
  using Float4 = float __attribute__((vector_size(16)));
  /// Lane 0 is the distance from the plane, lanes 1 to 3 are the distances beyond the sides, within
  /// the plane: x p.x + y p.y + z p.z - offset.
  struct alignas(64) Ways {
    Float4 x, y, z, offset;
  };

  static Float4 ways_to(const Ways& w, const Eigen::Vector3f& p) noexcept {
    return w.x * Float4{p.x(), p.x(), p.x(), p.x()} + w.y * Float4{p.y(), p.y(), p.y(), p.y()} +
           w.z * Float4{p.z(), p.z(), p.z(), p.z()} - w.offset;
  }
  [[nodiscard]] float squared_below(std::size_t index, const Place& place) const noexcept;
  static Ways ways_of(const Triangle& triangle, const Eigen::Vector3d& centre, double scale);

  std::vector<Ways> ways_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double scale_ = 1.0;
};

inline TriangleBounds::Place TriangleBounds::place(const Eigen::Vector3d& p) const noexcept {
  const Eigen::Vector3f q = ((p - centre_) * scale_).cast<float>();
  return {q, 1e-6f * (1.0f + q.cwiseAbs().maxCoeff())};
}

inline TriangleBounds::Segment TriangleBounds::segment(const Eigen::Vector3d& from,
                                                       const Eigen::Vector3d& to,
                                                       double radius) const noexcept {
  const Place begin = place(from);
  const Place end = place(to);
  return {begin.p, end.p,
          static_cast<float>(radius * scale_) * 1.00001f + std::max(begin.slack, end.slack)};
}

inline bool TriangleBounds::beside(std::size_t index, const Segment& segment) const noexcept {
  const Float4 from = ways_to(ways_[index], segment.from);
  const Float4 to = ways_to(ways_[index], segment.to);
  const Float4 nearer = from < to ? from : to;
  const Float4 reach = {segment.reach, segment.reach, segment.reach, segment.reach};
  const auto out = nearer > reach;
  return (out[0] | out[1] | out[2] | out[3]) != 0 ||
         (from[0] < -segment.reach && to[0] < -segment.reach);
}

// In the unit of the bounds.
inline float TriangleBounds::squared_below(std::size_t index, const Place& place) const noexcept {
  const Float4 way = ways_to(ways_[index], place.p);
  const float off = std::max(0.0f, std::abs(way[0]) - place.slack);
  const float out = std::max(0.0f, std::max(std::max(way[1], way[2]), way[3]) - place.slack);
  return off * off + out * out;
}

inline bool TriangleBounds::beyond(std::size_t index, const Place& place,
                                   double limit) const noexcept {
  const float most = static_cast<float>(limit * scale_);
  // Not ">=", because the square of a short limit may round to zero.
  return 0.99999f * squared_below(index, place) > most * most;
}

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Motion of a surface contact point (SCP) to its settled place: straight towards the device until a
// sweep stops it, then along the met planes until it no longer moves.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "reckon/haptics/geometry/constraint_planes.hpp"
#include "reckon/haptics/geometry/sweep_hit.hpp"

namespace reckon::haptics {

/// One update of an SCP. Every move is swept. It leads towards the point nearest to the device in a
/// convex set that contains the SCP. So it passes no surface, and |device - p| never grows.
///
/// Obstacles, all noexcept, in the frame of p [m]:
///   bool sweep(p, step, SweepHit&)    first surface on the way
///   bool within(p)                    p overlaps a solid that cannot be met from within
///   bool holds(ConstraintPlane, p)    the plane's face is right below p (false: unknown)
///   double clearance()                clearance of a settled p; a move below 1e-3 of it is none
///   double size()                     for the rounding of the planes
///   double held(lateral, planes, solution, sliding)   distance from the goal left by friction
template <class Obstacles>
struct ContactWalk {
  using Vector3d = Eigen::Vector3d;
  /// Greatest number of sweeps in one update; later updates finish a longer path.
  static constexpr int kMaxMoves = 256;
  /// Greatest number of slides over a curved surface or landings on one in an update. Each comes
  /// nearer to the settled place, by a share equal to the depth over the radius of curvature. Later
  /// updates finish the rest.
  static constexpr int kMostLandings = 48;

  const Obstacles& obstacles;
  const Vector3d& device;
  Vector3d p;
  bool sliding = false;  ///< in: before; out: whether it moved along a plane
  ConstraintPlanes planes{};
  ConstraintSolution solution{};
  Vector3d released_at = Vector3d::Zero();
  bool released = false;
  int landings = 0;
  double slide_share = 1.0;  ///< share of the allowed motion in the last slide over a surface

  /// Moves until nothing changes. @return whether p reached the device freely.
  [[nodiscard]] bool run() noexcept {
    if (walk()) return true;
    if (landings > 0) press();
    return false;
  }

 private:
  [[nodiscard]] bool walk() noexcept {
    for (int moves = 0; moves < kMaxMoves; ++moves) {
      Vector3d step;
      if (!next_step(step)) {
        if (planes.size() == 0) return true;
        if (held_by_faces() || !release()) return false;
        continue;
      }
      SweepHit hit;
      if (obstacles.sweep(p, step, hit)) {
        if (runs_along(hit)) {
          const bool settled = is_negligible(step);
          if (!settled && slide_over(step)) continue;
          if (settled || -hit.normal.dot(step) <= kGrazing * step.norm()) {
            if (!release()) return false;
            continue;
          }
        }
        stop_at(hit, step);
        if (!hit.curved || ++landings <= kMostLandings) continue;
        (void)next_step(step);  // for its normal and load
        return false;
      }
      if (planes.size() == 0) {
        p = device;
        return true;
      }
      move(step);
      if (held_by_faces() || !release()) return false;
    }
    return false;
  }

  // Shortest useful move, in clearances. The SCP counts as settled below it.
  static constexpr double kTinyMove = 1e-3;
  // Least cosine between the normals at two near places of one smooth surface.
  static constexpr double kSameSurface = 0.9;
  static constexpr double kGrazing = 1e-5;  // cosine to the step: a smaller one bars nothing more
  static constexpr double kLeastGain = 2.0 * (1.0 - kStopShare);
  static constexpr double kShortestSlide = 1.0 / 128.0;  // share of the allowed motion

  [[nodiscard]] double tiny() const noexcept { return kTinyMove * obstacles.clearance(); }

  // Stops p a margin before the surface and adds the plane that it met.
  void stop_at(const SweepHit& hit, const Vector3d& step) noexcept {
    const double level = hit.normal.dot(p + hit.t * step) + hit.margin;
    const double approach = -hit.normal.dot(step);
    const double t = hit.t - hit.margin / approach;
    if (t > 0.0) move(t * step);
    planes.add(
        {hit.normal, std::min(level, hit.normal.dot(p)), hit.triangle, hit.object, hit.on_face}, p);
  }

  // Whether the hit is on a surface along which p slides already. Another plane on it would bar all
  // but a tiny move.
  [[nodiscard]] bool runs_along(const SweepHit& hit) const noexcept {
    if (!hit.curved || planes.size() == 0) return false;
    for (std::size_t i = 0; i < solution.active_count; ++i) {
      if (planes[solution.active[i]].normal.dot(hit.normal) > kSameSurface) return true;
    }
    return false;
  }

  // Whether the gain of a slide by `step` on a flat surface is below the precision of a contact:
  // 0.1 um at 2 mm of depth.
  [[nodiscard]] bool is_negligible(const Vector3d& step) const noexcept {
    return step.squaredNorm() <= kLeastGain * obstacles.clearance() * (device - p).norm();
  }

  // Slides over the surface in two swept legs, up and then forward and down, and tries shorter ones
  // if that brings p no nearer. The first leg is swept from above and soon reaches the known free
  // p.
  [[nodiscard]] bool slide_over(const Vector3d& step) noexcept {
    const Vector3d up = solution.push.normalized();
    const double before = (p - device).squaredNorm();
    for (double share = slide_share; share > kShortestSlide; share *= 0.5) {
      const Vector3d goal = p + share * step;
      const Vector3d top = p + share * step.norm() * up;
      SweepHit hit;
      if (obstacles.within(top)) continue;
      const bool barred = obstacles.sweep(top, p - top, hit);
      if (barred && (1.0 - hit.t) * (p - top).norm() > obstacles.clearance()) continue;
      const Vector3d leg = goal - top;
      const bool met = obstacles.sweep(top, leg, hit);
      const double stop = met ? hit.t + hit.margin / hit.normal.dot(leg) : 1.0;
      const Vector3d end = top + std::max(0.0, stop) * leg;
      if (!((end - device).squaredNorm() < before) || (end - p).norm() <= tiny()) continue;
      p = end;
      sliding = true;
      planes.clear();
      slide_share = std::min(1.0, 2.0 * share);
      ++landings;
      return true;
    }
    return false;
  }

  // A move along a curved surface may end above it. So p moves straight down, at most by the
  // distance of the device.
  void press() noexcept {
    const Vector3d down = -solution.push;
    SweepHit hit;
    if (solution.active_count == 0 || !obstacles.sweep(p, down, hit)) return;
    const double t = hit.t + hit.margin / hit.normal.dot(down);
    if (t > 0.0) move(t * down);
  }

  void move(const Vector3d& step) noexcept {
    if (step.squaredNorm() <= tiny() * tiny()) return;
    if ((p + step - device).squaredNorm() > (p - device).squaredNorm()) return;
    p += step;
    if (planes.size() > 0) sliding = true;
  }

  // Step that the planes and friction allow; false if p need not or cannot move.
  [[nodiscard]] bool next_step(Vector3d& step) noexcept {
    const double tolerance = 1e-12 * (obstacles.size() + (device - p).norm());
    if (!planes.solve(device, tolerance, solution)) {
      solution.active_count = 0;
      return false;
    }
    step = solution.point - p;
    if (planes.size() == 0) return p != device;  // even if short: only a sweep may let it pass
    const double lateral = step.norm();
    const double held = obstacles.held(lateral, planes, solution, sliding);
    if (held > 0.0) {
      step = held < lateral ? Vector3d((1.0 - held / lateral) * step) : Vector3d::Zero();
    }
    return step.squaredNorm() > tiny() * tiny();
  }

  // Whether all planes with load belong to faces right below p: then p is settled, and not past an
  // edge.
  [[nodiscard]] bool held_by_faces() const noexcept {
    if (solution.active_count == 0) return false;
    for (std::size_t i = 0; i < solution.active_count; ++i) {
      if (!obstacles.holds(planes[solution.active[i]], p)) return false;
    }
    return true;
  }

  // Drops all planes to find which still hold p; false if that was done here before.
  [[nodiscard]] bool release() noexcept {
    if (released && released_at == p) return false;
    released = true;
    released_at = p;
    planes.clear();
    return true;
  }
};

}  // namespace reckon::haptics

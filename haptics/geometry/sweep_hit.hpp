// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where the way of a probe's centre first meets a surface, and the distances that keep rounding
// from letting it through.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace reckon::haptics {

/// Distance of a settled SCP from the true surface, relative to the object's size. Small enough not
/// to be felt (0.02 um on a 0.2 m object), a billion times the rounding of a double.
inline constexpr double kRelativeClearance = 1e-7;
/// Share of the clearance at which a sweep stops, so that a point at the clearance slides freely.
inline constexpr double kStopShare = 0.99;
/// Way [clearances] that rounding may take a sliding point nearer to a surface.
inline constexpr double kSlideSlack = 1e-4;

/// First contact of a moving probe with a surface.
struct SweepHit {
  double t = 1.0;                                    ///< share of the step, [0, 1]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, towards the side it came from
  double margin = 0.0;         ///< [m] that a settled centre keeps above where the sweep stopped
  std::uint32_t triangle = 0;  ///< of a mesh
  std::uint32_t object = 0;    ///< where there are several
  bool on_face = false;        ///< on a mesh triangle's flat; else round an edge or a corner
  /// Of an implicit surface: it may curve towards the way, or the way run along it with no proof
  /// that it is free.
  bool curved = false;
};

}  // namespace reckon::haptics

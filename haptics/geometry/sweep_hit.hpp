// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// First contact of a probe's centre with a surface, and the distances that prevent a passage by
// rounding.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace reckon::haptics {

/// Distance of a settled SCP from the true surface, relative to the object's size. It is too small
/// to be felt (0.02 um on a 0.2 m object), and a billion times the rounding of a double.
inline constexpr double kRelativeClearance = 1e-7;
/// Share of the clearance at which a sweep stops, so that a point at the clearance slides freely.
inline constexpr double kStopShare = 0.99;
/// Greatest approach [clearances] of a sliding point to a surface by rounding.
inline constexpr double kSlideSlack = 1e-4;

/// First contact of a moving probe with a surface.
struct SweepHit {
  double t = 1.0;                                    ///< share of the step, [0, 1]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, towards the side of the probe
  double margin = 0.0;         ///< [m], distance of a settled centre above the stop of the sweep
  std::uint32_t triangle = 0;  ///< of a mesh
  std::uint32_t object = 0;    ///< number of the object, if there are several
  bool on_face = false;        ///< on the flat of a mesh triangle; else round an edge or a corner
  /// For an implicit surface: it may curve towards the path, or run along it without a proof that
  /// the path is free.
  bool curved = false;
};

}  // namespace reckon::haptics

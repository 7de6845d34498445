// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Origin of a scene frame for a capture without one: at a position in the capture.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/geodetic.hpp"
#include "reckon/peer/settings/entity_config.hpp"

namespace reckon::tools {

/// The geodetic coordinates of a geocentric position [m], finite. Height is limited to +-1e8 m. A
/// position nearer than 1000 km to the earth's centre is fictitious: it is mapped to latitude 0, at
/// its distance from the axis.
[[nodiscard]] inline peer::OriginConfig origin_at(const Eigen::Vector3d& position) noexcept {
  constexpr double kDegree = std::numbers::pi / 180;  // [rad]
  constexpr double kGreatestHeight = 1e8;             // of a LocalFrame [m]
  constexpr double kEquator = 6378137.0;              // WGS84, its radius [m]
  const double x = position.x(), y = position.y();
  const auto place = pdu::geodetic_from({x, y, position.z()});
  if (!place.has_value()) return {0, std::atan2(y, x), std::hypot(x, y) - kEquator};
  return {place->latitude_deg * kDegree, place->longitude_deg * kDegree,
          std::clamp(place->height, -kGreatestHeight, kGreatestHeight)};
}

/// The scene frame with that origin: east, north, up of the ellipsoid.
[[nodiscard]] inline deadreckon::LocalFrame local_frame_at(const Eigen::Vector3d& position) {
  const peer::OriginConfig origin = origin_at(position);
  return {origin.latitude, origin.longitude, origin.height};
}

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/origin_at.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reckon/pdu/geodetic.hpp"

namespace reckon::tools {

peer::OriginConfig origin_at(const Eigen::Vector3d& position) noexcept {
  constexpr double kDegree = std::numbers::pi / 180;  // [rad]
  constexpr double kGreatestHeight = 1e8;             // of a LocalFrame [m]
  constexpr double kEquator = 6378137.0;              // WGS84, its radius [m]
  const double x = position.x(), y = position.y();
  const auto place = pdu::geodetic_from({x, y, position.z()});
  if (!place.has_value()) return {0, std::atan2(y, x), std::hypot(x, y) - kEquator};
  return {place->latitude_deg * kDegree, place->longitude_deg * kDegree,
          std::clamp(place->height, -kGreatestHeight, kGreatestHeight)};
}

deadreckon::LocalFrame local_frame_at(const Eigen::Vector3d& position) {
  const peer::OriginConfig origin = origin_at(position);
  return {origin.latitude, origin.longitude, origin.height};
}

}  // namespace reckon::tools

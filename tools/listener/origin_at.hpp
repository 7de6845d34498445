// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Origin of a scene frame for a capture without one: at a position in the capture.
#pragma once

#include <Eigen/Core>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/peer/settings/entity_config.hpp"

namespace reckon::tools {

/// The geodetic coordinates of a geocentric position [m], finite. Height is limited to +-1e8 m. A
/// position nearer than 1000 km to the earth's centre is fictitious: it is mapped to latitude 0, at
/// its distance from the axis.
[[nodiscard]] peer::OriginConfig origin_at(const Eigen::Vector3d& position) noexcept;

/// The scene frame with that origin: east, north, up of the ellipsoid.
[[nodiscard]] deadreckon::LocalFrame local_frame_at(const Eigen::Vector3d& position);

}  // namespace reckon::tools

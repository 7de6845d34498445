// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The origin of a scene frame where a capture has none: at a position in it.
#pragma once

#include <Eigen/Core>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/peer/scene/peer_config.hpp"

namespace reckon::tools {

/// The geodetic place of a geocentric position [m], finite. Height is cut to +-1e8 m. Nearer than
/// 1000 km to the earth's centre only a made-up position can be: there the place is at latitude 0,
/// as far from the axis as the position.
[[nodiscard]] peer::OriginConfig origin_at(const Eigen::Vector3d& position) noexcept;

/// The scene frame with that origin: east, north, up of the ellipsoid there.
[[nodiscard]] deadreckon::LocalFrame local_frame_at(const Eigen::Vector3d& position);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts points to the type of the area-of-interest manager, which uses no matrix library.
#pragma once

#include <Eigen/Core>

#include "reckon/aoim/cells/position.hpp"

namespace reckon::peer {

/// The same point of the scene frame [m].
[[nodiscard]] inline aoim::Position to_position(const Eigen::Vector3d& p) noexcept {
  return {p.x(), p.y(), p.z()};
}

}  // namespace reckon::peer

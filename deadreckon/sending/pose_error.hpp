// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a rule about sending looks at: by how much peers are wrong.
#pragma once

#include <Eigen/Core>

namespace reckon::deadreckon {

/// By how much a prediction is off, reference axes.
struct PoseError {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();       ///< True minus predicted [m].
  Eigen::Vector3d true_velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

}  // namespace reckon::deadreckon

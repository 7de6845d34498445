// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Input of a send rule: the error at peers.
#pragma once

#include <Eigen/Core>

namespace reckon::deadreckon {

/// Error of a prediction, reference axes.
struct PoseError {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();       ///< True minus predicted [m].
  Eigen::Vector3d true_velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

}  // namespace reckon::deadreckon

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The true motion of one entity over time; a study feeds it to an owner.
#pragma once

#include <string>
#include <vector>

#include "reckon/deadreckon/motion/motion_history.hpp"

namespace reckon::bench {

/// Samples in order of their times, which increase strictly; all finite. Position in one Cartesian
/// frame of the track itself [m].
struct Track {
  std::string name;  ///< of the entity, for output
  std::vector<deadreckon::MotionSample> samples;
};

}  // namespace reckon::bench

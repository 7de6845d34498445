// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The true motion of one entity over time, as a study replays it to an owner.
#pragma once

#include <string>
#include <vector>

#include "reckon/deadreckon/motion/motion_history.hpp"

namespace reckon::bench {

/// Samples in the order of their times, which grow strictly; all finite. Position in one Cartesian
/// frame of the track's own [m].
struct Track {
  std::string name;  ///< of the entity, for people
  std::vector<deadreckon::MotionSample> samples;
};

}  // namespace reckon::bench

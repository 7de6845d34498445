// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One run of dead reckoning, sample by sample, as a CSV file: the values behind the sums of a
// study, for pictures and spreadsheets.
#pragma once

#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/pose/pose_study.hpp"

namespace reckon::bench {

/// A row for each sample that a viewer drew:
/// t_s,entity,true_x_m,true_y_m,true_z_m,shown_x_m,shown_y_m,shown_z_m,error_m,angle_rad,
/// drawn_speed_mps,sent,lost,arrived. The speed is empty at an entity's first row.
class PoseTrace {
 public:
  /// Begins the file. Entities are identified by the names of the tracks; a track without a name by
  /// its number from 1. @throws UsageError if the file cannot be written.
  PoseTrace(std::string path, std::span<const Track> tracks);

  void write(const PoseSample& sample);

  /// Ends the file. @throws UsageError if it could not be written completely.
  void close();

 private:
  std::string path_;
  std::vector<std::string> entities_;
  std::ofstream file_;
  std::string line_;
};

}  // namespace reckon::bench

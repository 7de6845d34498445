// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/hand_trace_file.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/peer/tracks/motion_columns.hpp"

namespace reckon::peer {

haptics::HandTrace read_hand_trace(const std::filesystem::path& file,
                                   const haptics::HandTraceOptions& options) {
  const haptics::LoadBudget budget;
  CsvReader csv(file);
  MotionColumns columns(csv);
  std::vector<double> times;
  std::vector<Eigen::Vector3d> positions;
  while (csv.next()) {
    times.push_back(columns.time());
    positions.push_back(columns.position());
  }
  if (times.empty()) throw CsvError(fmt::format("{}: no samples after the header", file.string()));
  return {std::move(times), std::move(positions), options};
}

}  // namespace reckon::peer

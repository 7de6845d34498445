// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/hand_trace_file.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace reckon::peer {
namespace {

std::size_t column_of(const CsvReader& csv, std::string_view name) {
  if (const auto place = csv.find(name)) return *place;
  csv.fail(0, fmt::format("no column {}; the header must name t_s, px_m, py_m and pz_m", name));
}

}  // namespace

haptics::HandTrace read_hand_trace(const std::filesystem::path& file,
                                   const haptics::HandTraceOptions& options) {
  CsvReader csv(file);
  const std::size_t time = column_of(csv, "t_s");
  const std::array<std::size_t, 3> axes{column_of(csv, "px_m"), column_of(csv, "py_m"),
                                        column_of(csv, "pz_m")};
  std::vector<double> times;
  std::vector<Eigen::Vector3d> positions;
  while (csv.next()) {
    const double now = csv.required(time);
    if (!times.empty() && !(now > times.back()))
      csv.fail(time, fmt::format("t_s does not grow: {} after {}", now, times.back()));
    times.push_back(now);
    positions.emplace_back(csv.required(axes[0]), csv.required(axes[1]), csv.required(axes[2]));
  }
  if (times.empty()) throw CsvError(fmt::format("{}: no samples after the header", file.string()));
  return {std::move(times), std::move(positions), options};
}

}  // namespace reckon::peer

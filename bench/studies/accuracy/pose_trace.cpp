// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/pose_trace.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
PoseTrace::PoseTrace(std::string path, std::span<const Track> tracks)
    : path_(std::move(path)), file_(path_, std::ios::binary | std::ios::trunc) {
  if (!file_)
    throw tools::UsageError(
        fmt::format("{}: cannot be written; name a file in a writable folder", path_));
  for (const Track& track : tracks)
    entities_.push_back(track.name.empty() ? fmt::format("{}", entities_.size() + 1)
                                           : csv_cell(track.name));
  file_ << "t_s,entity,true_x_m,true_y_m,true_z_m,shown_x_m,shown_y_m,shown_z_m,error_m,angle_rad,"
           "drawn_speed_mps,sent,lost,arrived\n";
}

void PoseTrace::write(const PoseSample& sample) {
  line_.clear();
  const auto to = std::back_inserter(line_);
  fmt::format_to(to, FMT_COMPILE("{:.6f},{}"), sample.truth.time, entities_[sample.track]);
  for (const Eigen::Vector3d& place : {sample.truth.position, sample.shown.position})
    fmt::format_to(to, FMT_COMPILE(",{:.9g},{:.9g},{:.9g}"), place.x(), place.y(), place.z());
  fmt::format_to(to, FMT_COMPILE(",{:.9g},{:.9g},"), sample.error, sample.angle);
  if (sample.drawn_speed) fmt::format_to(to, FMT_COMPILE("{:.9g}"), *sample.drawn_speed);
  fmt::format_to(to, FMT_COMPILE(",{},{},{}\n"), sample.sent, sample.lost, sample.arrived);
  file_ << line_;
}

void PoseTrace::close() {
  file_.close();
  if (!file_) throw tools::UsageError(fmt::format("{}: could not be written completely", path_));
}

}  // namespace reckon::bench

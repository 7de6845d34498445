// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads the samples of a track from a file, and keeps the curves made of them.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "reckon/haptics/input_files/load_budget.hpp"
#include "reckon/peer/tracks/entity_track.hpp"
#include "reckon/peer/tracks/motion_columns.hpp"

namespace reckon::peer {
namespace {

/// The orientation of each row; nothing if the file has no columns for it.
class OrientationColumns {
 public:
  explicit OrientationColumns(const CsvReader& csv) : csv_(csv), heading_(csv.find("heading_rad")) {
    constexpr std::array<const char*, 4> kNames{"qw", "qx", "qy", "qz"};
    std::size_t found = 0;
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      const auto place = csv.find(kNames[i]);
      if (place) quaternion_[i] = *place;
      if (place) ++found;
    }
    has_quaternion_ = found == kNames.size();
    if (found != 0 && !has_quaternion_) {
      csv.fail(0, "an orientation needs all of qw, qx, qy and qz");
    }
  }

  [[nodiscard]] bool any() const noexcept { return has_quaternion_ || heading_; }

  [[nodiscard]] Eigen::Quaterniond orientation() const {
    if (!has_quaternion_) return level(csv_.required(*heading_));
    const Eigen::Quaterniond q(csv_.required(quaternion_[0]), csv_.required(quaternion_[1]),
                               csv_.required(quaternion_[2]), csv_.required(quaternion_[3]));
    const double length = q.norm();
    if (std::abs(length - 1.0) < 1e-2) return q.normalized();
    csv_.fail(quaternion_[0],
              fmt::format("qw, qx, qy and qz have length {:.3g}; a unit quaternion has 1", length));
  }

 private:
  // Body x along the heading, y to its right, z down.
  static Eigen::Quaterniond level(double heading) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())) *
           Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  }

  const CsvReader& csv_;
  std::optional<std::size_t> heading_;
  std::array<std::size_t, 4> quaternion_{};
  bool has_quaternion_ = false;
};

}  // namespace

TrackSamples read_track_samples(const std::filesystem::path& file) {
  const haptics::LoadBudget budget;
  CsvReader csv(file);
  MotionColumns motion(csv);
  const OrientationColumns turning(csv);
  TrackSamples samples;
  while (csv.next()) {
    const double time = motion.time();
    if (!samples.times.empty() && time - samples.times.back() < TrackSamples::kLeastStep) {
      csv.fail(motion.time_column(), "t_s increases by less than 1 us; remove one of the rows");
    }
    samples.times.push_back(time);
    samples.positions.push_back(motion.position());
    if (samples.positions.back().cwiseAbs().maxCoeff() > TrackSamples::kFarthest) {
      csv.fail(motion.time_column(), "the position is more than 1000 km from the origin");
    }
    if (turning.any()) samples.orientations.push_back(turning.orientation());
  }
  if (samples.times.empty()) {
    throw CsvError(fmt::format("{}: no samples after the header", file.string()));
  }
  return samples;
}

std::shared_ptr<const TrackCurve> TrackShelf::curve(const std::filesystem::path& file,
                                                    std::optional<bool> repeat, TrackTurn turn) {
  auto& held = curves_[{file, repeat, turn}];
  if (!held) held = std::make_shared<const TrackCurve>(read_track_samples(file), repeat, turn);
  return held;
}

}  // namespace reckon::peer

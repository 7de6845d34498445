// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "reckon/bench/studies/tracks/track_builder.hpp"
#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/tracks/csv_reader.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using deadreckon::LocalFrame;
using deadreckon::MotionSample;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Place = std::optional<std::size_t>;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kKnot = 1852.0 / 3600;  // [m/s]
constexpr double kFarthest = 1e9;        // [m], the limit of positions on the wire

/// Columns that belong together; the last may be missing if `needed` is less than all.
struct Group {
  std::array<Place, 4> places;
  bool present = false;

  Group() = default;
  Group(const peer::CsvReader& csv, std::initializer_list<std::string_view> names,
        std::size_t needed) {
    std::size_t i = 0;
    for (const std::string_view name : names) places[i++] = csv.find(name);
    present = true;
    for (std::size_t k = 0; k < needed; ++k) present = present && places[k].has_value();
  }
};

/// The column of each quantity.
struct Columns {
  std::size_t time = 0;
  Place id;
  Group position, geodetic, velocity, speed, course, euler, quaternion, heading;

  explicit Columns(const peer::CsvReader& csv)
      : id(csv.find("id")),
        position(csv, {"x_m", "y_m", "z_m"}, 2),
        geodetic(csv, {"lat_deg", "lon_deg", "height_m"}, 2),
        velocity(csv, {"vx_mps", "vy_mps", "vz_mps"}, 2),
        speed(csv, {"speed_mps", "heading_rad"}, 2),
        course(csv, {"sog_kn", "cog_deg"}, 2),
        euler(csv, {"psi_rad", "theta_rad", "phi_rad"}, 3),
        quaternion(csv, {"qw", "qx", "qy", "qz"}, 4),
        heading(csv, {"heading_rad"}, 1) {
    if (!position.present) position = Group(csv, {"px_m", "py_m", "pz_m"}, 2);
    const Place found = csv.find("t_s");
    if (!found) missing(csv, "t_s", "the time in seconds");
    time = *found;
    if (!position.present && !geodetic.present)
      missing(csv, "x_m", "a position: x_m,y_m[,z_m] or px_m,py_m[,pz_m] or lat_deg,lon_deg");
  }

 private:
  [[noreturn]] static void missing(const peer::CsvReader& csv, std::string_view name,
                                   std::string_view what) {
    std::vector<std::string_view> words(csv.columns().begin(), csv.columns().end());
    const std::string_view nearest = peer::nearest_word(name, words);
    csv.fail(0, fmt::format("the first line has no column {}; add {}{}", name, what,
                            nearest.empty() ? "" : fmt::format(" (it has '{}')", nearest)));
  }
};

double or_zero(const peer::CsvReader& csv, const Place& place) {
  return place ? csv.number(*place).value_or(0) : 0;
}

/// Converts the rows of one table into samples.
class RowReader {
 public:
  explicit RowReader(const peer::CsvReader& csv) : csv_(csv), columns_(csv) {}

  [[nodiscard]] ToldSample sample() {
    ToldSample told;
    told.motion.time = csv_.required(columns_.time);
    if (columns_.position.present)
      read_position(told.motion);
    else
      read_geodetic(told.motion);
    read_velocity(told);
    read_orientation(told);
    if (columns_.geodetic.present && !columns_.position.present) into_frame(told);
    return told;
  }
  [[nodiscard]] std::string_view id() const {
    return columns_.id ? csv_.text(*columns_.id) : std::string_view("1");
  }
  [[nodiscard]] bool has_orientation() const noexcept {
    return columns_.euler.present || columns_.quaternion.present || columns_.heading.present;
  }

 private:
  void read_position(MotionSample& motion) const {
    const auto& places = columns_.position.places;
    motion.position = {csv_.required(*places[0]), csv_.required(*places[1]),
                       or_zero(csv_, places[2])};
    if (motion.position.cwiseAbs().maxCoeff() > kFarthest)
      csv_.fail(*places[0], "the position is beyond 1e9 m; use metres from a nearby origin");
  }

  void read_geodetic(MotionSample& motion) {
    const auto& places = columns_.geodetic.places;
    const double latitude =
        std::clamp(in_range(*places[0], 90) * kDegree, -std::numbers::pi / 2, std::numbers::pi / 2);
    const double longitude = in_range(*places[1], 360) * kDegree;
    const double height = or_zero(csv_, places[2]);
    if (std::abs(height) > 1e8) csv_.fail(*places[2], "the height is beyond 1e8 m");
    here_.emplace(latitude, longitude, height);
    if (!origin_) origin_.emplace(latitude, longitude, 0);
    motion.position = origin_->scene_from_world(here_->origin());
  }

  [[nodiscard]] double in_range(std::size_t column, double most) const {
    const double value = csv_.required(column);
    if (std::abs(value) > most)
      csv_.fail(column, fmt::format("{:g} is outside of +-{:g} degrees", value, most));
    return value;
  }

  void read_velocity(ToldSample& told) const {
    const auto pair = [&](const Group& group) -> std::optional<std::array<double, 2>> {
      if (!group.present) return std::nullopt;
      const auto a = csv_.number(*group.places[0]);
      const auto b = csv_.number(*group.places[1]);
      if (!a || !b) return std::nullopt;
      return std::array{*a, *b};
    };
    Vector3d& v = told.motion.velocity;
    if (const auto xy = pair(columns_.velocity))
      v = {(*xy)[0], (*xy)[1], or_zero(csv_, columns_.velocity.places[2])};
    else if (const auto speed = pair(columns_.speed))
      v = (*speed)[0] * Vector3d(std::cos((*speed)[1]), std::sin((*speed)[1]), 0);
    else if (const auto course = pair(columns_.course))
      v = (*course)[0] * kKnot *
          Vector3d(std::sin((*course)[1] * kDegree), std::cos((*course)[1] * kDegree), 0);
    else
      return;
    told.has_velocity = true;
  }

  void read_orientation(ToldSample& told) const {
    Quaterniond& q = told.motion.orientation;
    if (columns_.euler.present) {
      const auto& e = columns_.euler.places;
      q = deadreckon::quaternion_from_euler(
          {csv_.required(*e[0]), csv_.required(*e[1]), csv_.required(*e[2])});
    } else if (columns_.quaternion.present) {
      const auto& p = columns_.quaternion.places;
      q = Quaterniond(csv_.required(*p[0]), csv_.required(*p[1]), csv_.required(*p[2]),
                      csv_.required(*p[3]));
      const double norm = q.norm();
      if (!(std::abs(norm - 1) < 0.01))
        csv_.fail(*p[0], fmt::format("the quaternion has length {:.3g}; it must be 1", norm));
      q.normalize();
    } else if (columns_.heading.present) {
      const auto heading = csv_.number(*columns_.heading.places[0]);
      if (!heading) return;
      q = Eigen::AngleAxisd(*heading, Vector3d::UnitZ());
    } else {
      return;
    }
    told.has_orientation = true;
  }

  /// Converts from east, north and up at the row's own position.
  void into_frame(ToldSample& told) const {
    MotionSample& motion = told.motion;
    motion.velocity =
        origin_->scene_from_world_vector(here_->world_from_scene_vector(motion.velocity));
    motion.orientation = origin_->scene_from_world(here_->world_from_scene(motion.orientation));
    motion.orientation.normalize();
  }

  const peer::CsvReader& csv_;
  Columns columns_;
  std::optional<LocalFrame> origin_, here_;
};

std::string note_of(const TrackBuilder& builder) {
  std::string note;
  if (builder.repeated() > 0)
    note += fmt::format("{} dropped, because a later one has the same id and time. ",
                        tools::counted(builder.repeated(), "row"));
  if (builder.disordered() > 0)
    note += fmt::format("{} after a later one of the same id: sorted by time. ",
                        tools::counted(builder.disordered(), "row"));
  if (!note.empty()) note.pop_back();
  return note;
}

}  // namespace

TrackFile read_track_table(const std::filesystem::path& path) {
  peer::CsvReader csv(path);
  RowReader rows(csv);
  TrackBuilder builder;
  while (csv.next()) {
    const ToldSample sample = rows.sample();
    builder.add(rows.id(), sample);
  }
  TrackFile file;
  file.name = path.filename().string();
  file.tracks = builder.finish();
  if (file.tracks.empty())
    throw tools::UsageError(fmt::format("{}: no rows after the header", path.string()));
  file.note = note_of(builder);
  file.has_orientation = rows.has_orientation();
  return file;
}

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The true motion of an entity that follows a recorded track. Its owner compares the dead reckoning
// of its peers with this motion.
//
//   TrackShelf shelf;  // many entities share one file
//   EntityTrack truck(shelf.curve("truck_track.csv"), {100, 0, 0});
//   const deadreckon::KinematicState now = truck.at(12.5);
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/peer/tracks/csv_reader.hpp"

namespace reckon::peer {

/// The samples of one motion, as read from a file.
struct TrackSamples {
  static constexpr double kLeastStep = 1e-6;  ///< [s]
  static constexpr double kFarthest = 1e6;    ///< [m] from the origin, each axis

  std::vector<double> times;                     ///< [s], growing by kLeastStep at least
  std::vector<Eigen::Vector3d> positions;        ///< [m], S; one for each time
  std::vector<Eigen::Quaterniond> orientations;  ///< body to S; one for each time, or empty
};

/// Reads a table with a header; columns t_s, px_m, py_m, pz_m and perhaps qw, qx, qy, qz (body to
/// S) or heading_rad (anticlockwise from east, level) in any order, others ignored. @throws
/// CsvError "file:line:column: what", with the remedy.
[[nodiscard]] TrackSamples read_track_samples(const std::filesystem::path& file);

/// Source of the orientation on a track.
enum class TrackTurn : std::uint8_t {
  held,        ///< the entity keeps its own orientation
  sampled,     ///< from the samples; as `held` if they have none
  nose_ahead,  ///< from the samples; if they have none, level and along the velocity
};

/// The part of a track between two samples.
struct TrackPiece {
  double begin = 0, end = 0;  ///< [s]
  double per_span = 0;        ///< [1/s], 1 / (end - begin)
  bool turns = false;
  /// Coefficients of the position [m], S. The argument runs from 0 at `begin` to 1 at `end`.
  std::array<Eigen::Vector3d, 6> c{};
  /// Orientation at `begin`, and coefficients of the rotation vector from there [rad], body axes.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  std::array<Eigen::Vector3d, 3> r{};

  /// Motion at a time [s] between begin and end.
  [[nodiscard]] deadreckon::KinematicState at(double time) const noexcept;
};

/// Samples as a function of time with continuous acceleration and angular velocity. The curve is
/// quintic Hermite; slopes and curvatures come from the parabola through three neighbours. An
/// entity that stops in the samples stops on the curve. Where a track turns by an angle a [rad]
/// between two samples, the relative error of the acceleration is up to about a, so sample turns
/// finely. A repeating track returns from its last point to the first at its mean speed. Any other
/// track comes to rest at its end. Immutable; any thread.
class TrackCurve {
 public:
  /// @param repeat without a value, the track repeats if its last point is within 1.5 mean steps of
  /// the first
  /// @throws std::invalid_argument without samples, or for samples that are not finite or break the
  /// bounds of TrackSamples
  explicit TrackCurve(TrackSamples samples, std::optional<bool> repeat = {},
                      TrackTurn turn = TrackTurn::nose_ahead);

  /// Motion at a time [s] since the start, reference axes S. Times below 0 and NaN give the start.
  /// The returned state has the algorithm `static_`; the caller sets the one that it sends. The
  /// orientation is the identity if turns() is false. No allocation, about 50 ns for any length.
  [[nodiscard]] deadreckon::KinematicState at(double time) const noexcept;

  /// The time that at() uses for `time`: at least 0, and modulo duration() if the track repeats.
  [[nodiscard]] double within(double time) const noexcept;
  /// The piece for a time within [0, duration()).
  [[nodiscard]] const TrackPiece& piece_at(double time) const noexcept;

  /// [s], of the samples, plus the way back if the track repeats.
  [[nodiscard]] double duration() const noexcept { return end_; }
  /// [m], along the samples.
  [[nodiscard]] double length() const noexcept { return length_; }
  [[nodiscard]] bool repeats() const noexcept { return repeat_; }
  /// Whether it has an orientation of its own.
  [[nodiscard]] bool turns() const noexcept { return turns_; }
  /// Memory in use [octets].
  [[nodiscard]] std::size_t octets() const noexcept;

 private:
  struct Knot;
  [[nodiscard]] std::vector<Knot> knots_of(const TrackSamples& samples) const;
  void close(std::vector<Knot>& knots) const;
  void set_rates(std::vector<Knot>& knots) const;
  void face_ahead(std::vector<Knot>& knots);
  void set_turning(std::vector<Knot>& knots) const;
  [[nodiscard]] TrackPiece piece_between(const Knot& a, const Knot& b) const;
  void build(const std::vector<Knot>& knots);
  void build_index();

  std::vector<TrackPiece> pieces_;
  std::vector<std::uint32_t> index_;  // piece at each of as many equal steps of time
  double steps_per_second_ = 0;
  double end_ = 0;     // [s]
  double length_ = 0;  // [m]
  bool repeat_ = false;
  bool turns_ = false;
  Eigen::Vector3d last_position_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond last_orientation_ = Eigen::Quaterniond::Identity();
};

/// One entity that follows a curve or is at rest. Many entities may share one curve. Each entity
/// keeps a copy of its present piece, so that the pieces of many entities are adjacent in memory.
/// One thread.
class EntityTrack {
 public:
  /// Makes an entity at rest. @param position [m] S. @param orientation body to S, unit.
  explicit EntityTrack(const Eigen::Vector3d& position = Eigen::Vector3d::Zero(),
                       const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity());

  /// Follows `curve`. @param offset [m] S, added to its positions. @param orientation is used if
  /// the curve has none. @param speed > 0; 2 plays twice as fast.
  EntityTrack(std::shared_ptr<const TrackCurve> curve, const Eigen::Vector3d& offset,
              const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity(),
              double speed = 1.0);

  /// True motion at a time [s] since the start, reference axes S (angular velocity: body axes), as
  /// TrackCurve::at(). Times may come in any order. No allocation; 50 ns, or 80 ns if the curve
  /// turns, also when ten thousand entities are evaluated one after the other.
  [[nodiscard]] deadreckon::KinematicState at(double time) noexcept;

  [[nodiscard]] bool moves() const noexcept { return curve_ != nullptr; }
  /// Null for an entity at rest.
  [[nodiscard]] const TrackCurve* curve() const noexcept { return curve_.get(); }

 private:
  TrackPiece piece_;  // of curve_ at the last requested time; empty at first
  Eigen::Vector3d offset_;
  Eigen::Quaterniond orientation_;
  double speed_ = 1.0;
  double end_ = 0;  // [s], of curve_
  bool repeat_ = false;
  bool turns_ = false;
  std::shared_ptr<const TrackCurve> curve_;
};

/// Curves by file, each read once.
class TrackShelf {
 public:
  /// @throws CsvError from read_track_samples.
  [[nodiscard]] std::shared_ptr<const TrackCurve> curve(const std::filesystem::path& file,
                                                        std::optional<bool> repeat = {},
                                                        TrackTurn turn = TrackTurn::nose_ahead);

 private:
  std::map<std::tuple<std::filesystem::path, std::optional<bool>, TrackTurn>,
           std::shared_ptr<const TrackCurve>>
      curves_;
};

}  // namespace reckon::peer

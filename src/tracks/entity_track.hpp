// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The true motion of an entity that its owner moves along a recorded track: what it predicts for
// others is held against this.
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

/// What a file tells about one motion.
struct TrackSamples {
  static constexpr double kLeastStep = 1e-6;  ///< [s]
  static constexpr double kFarthest = 1e6;    ///< [m] from the origin, each axis

  std::vector<double> times;                     ///< [s], growing by kLeastStep at least
  std::vector<Eigen::Vector3d> positions;        ///< [m], S; as many
  std::vector<Eigen::Quaterniond> orientations;  ///< body to S; as many, or none: not stated
};

/// Reads a table with a header; columns t_s, px_m, py_m, pz_m and perhaps qw, qx, qy, qz (body to
/// S) or heading_rad (anticlockwise from east, level) in any order, others ignored. @throws
/// CsvError "file:line:column: what", with the remedy.
[[nodiscard]] TrackSamples read_track_samples(const std::filesystem::path& file);

/// How a track is turned.
enum class TrackTurn : std::uint8_t {
  held,        ///< not at all: the entity's own orientation stays
  sampled,     ///< as the samples tell; held where they do not
  nose_ahead,  ///< as the samples tell; where they do not, level and along its way
};

/// A track from one sample to the next.
struct TrackPiece {
  double begin = 0, end = 0;  ///< [s]
  double per_span = 0;        ///< [1/s], 1 / (end - begin)
  bool turns = false;
  /// Polynomial of the share of the piece that is behind; its position [m], S.
  std::array<Eigen::Vector3d, 6> c{};
  /// At its begin, and the polynomial of the rotation vector [rad] from there; body axes.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  std::array<Eigen::Vector3d, 3> r{};

  /// Motion at a time [s] between begin and end.
  [[nodiscard]] deadreckon::KinematicState at(double time) const noexcept;
};

/// Samples as a function of time with continuous acceleration and angular velocity: quintic
/// Hermite with the slopes and curvatures of the parabola through three neighbours, so that a stop
/// stays a stop. In a turn of a few degrees between samples, a [rad], the acceleration is off by up
/// to about a of itself: sample turns finely. A track that repeats goes back from its last point to
/// the first at its mean speed; one that does not comes to rest at its end. Immutable; any thread.
class TrackCurve {
 public:
  /// `repeat` none: where the last point lies no farther from the first than 1.5 mean steps.
  /// @throws std::invalid_argument unless there is a sample and all are as TrackSamples says,
  /// finite, within 1000 km.
  explicit TrackCurve(TrackSamples samples, std::optional<bool> repeat = {},
                      TrackTurn turn = TrackTurn::nose_ahead);

  /// Motion at a time [s] since the start, reference axes S; before 0 and for NaN the start. Its
  /// algorithm is `static_`: the caller chooses one. The orientation is the identity where the
  /// curve does not turn. No allocation, one look-up whatever the length, about 50 ns.
  [[nodiscard]] deadreckon::KinematicState at(double time) const noexcept;

  /// `time` as at() takes it: within a round where it repeats, at least 0.
  [[nodiscard]] double within(double time) const noexcept;
  /// The piece for a time within [0, duration()).
  [[nodiscard]] const TrackPiece& piece_at(double time) const noexcept;

  /// [s], of one round: the samples and, when repeating, the way back.
  [[nodiscard]] double duration() const noexcept { return end_; }
  /// [m], along the samples.
  [[nodiscard]] double length() const noexcept { return length_; }
  [[nodiscard]] bool repeats() const noexcept { return repeat_; }
  /// Whether it has an orientation of its own.
  [[nodiscard]] bool turns() const noexcept { return turns_; }
  /// [octets] that it holds.
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
  std::vector<std::uint32_t> index_;  // piece at each of as many even steps of time
  double steps_per_second_ = 0;
  double end_ = 0;     // [s]
  double length_ = 0;  // [m]
  bool repeat_ = false;
  bool turns_ = false;
  Eigen::Vector3d last_position_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond last_orientation_ = Eigen::Quaterniond::Identity();
};

/// One entity on a curve that it may share with others; or one that stands. It keeps the piece that
/// it is on, so that those of ten thousand lie side by side. One thread.
class EntityTrack {
 public:
  /// Stands for ever. @param position [m] S. @param orientation body to S, unit.
  explicit EntityTrack(const Eigen::Vector3d& position = Eigen::Vector3d::Zero(),
                       const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity());

  /// Follows `curve`. @param offset [m] S, added to its positions. @param orientation where the
  /// curve does not turn. @param speed > 0; 2 plays twice as fast.
  EntityTrack(std::shared_ptr<const TrackCurve> curve, const Eigen::Vector3d& offset,
              const Eigen::Quaterniond& orientation = Eigen::Quaterniond::Identity(),
              double speed = 1.0);

  /// True motion at a time [s] since the start, reference axes S (angular velocity: body axes), as
  /// TrackCurve::at(). Any order of times. No allocation; 50 ns, 80 ns for one that turns, also in
  /// turn with ten thousand others.
  [[nodiscard]] deadreckon::KinematicState at(double time) noexcept;

  [[nodiscard]] bool moves() const noexcept { return curve_ != nullptr; }
  /// None for what stands.
  [[nodiscard]] const TrackCurve* curve() const noexcept { return curve_.get(); }

 private:
  TrackPiece piece_;  // of curve_, where it was asked last; empty at first
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
  /// @throws CsvError as read_track_samples.
  [[nodiscard]] std::shared_ptr<const TrackCurve> curve(const std::filesystem::path& file,
                                                        std::optional<bool> repeat = {},
                                                        TrackTurn turn = TrackTurn::nose_ahead);

 private:
  std::map<std::tuple<std::filesystem::path, std::optional<bool>, TrackTurn>,
           std::shared_ptr<const TrackCurve>>
      curves_;
};

}  // namespace reckon::peer

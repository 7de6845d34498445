// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A recorded exercise at another place on the earth.
#pragma once

#include <optional>
#include <string>

#include "reckon/deadreckon/motion/geocentric.hpp"

namespace reckon::tools {

/// A rigid motion of the earth that moves the surroundings of one point to another point.
/// Distances, heights above the point and bearings from local north stay the same.
class PlaceShift {
 public:
  PlaceShift(const deadreckon::LocalFrame& from, const deadreckon::LocalFrame& to)
      : from_(from), to_(to) {}

  /// A geocentric point [m].
  [[nodiscard]] Eigen::Vector3d point(const Eigen::Vector3d& p) const {
    return to_.world_from_scene(from_.scene_from_world(p));
  }
  /// A vector in geocentric axes.
  [[nodiscard]] Eigen::Vector3d vector(const Eigen::Vector3d& v) const {
    return to_.world_from_scene_vector(from_.scene_from_world_vector(v));
  }
  /// A body's orientation against the geocentric axes.
  [[nodiscard]] Eigen::Quaterniond orientation(const Eigen::Quaterniond& q) const {
    return to_.world_from_scene(from_.scene_from_world(q));
  }
  /// The rotation of vectors.
  [[nodiscard]] Eigen::Matrix3d rotation() const {
    return to_.rotation() * from_.rotation().transpose();
  }

 private:
  deadreckon::LocalFrame from_;
  deadreckon::LocalFrame to_;
};

/// A shift as typed: "48.14,11.58=34.05,-118.24", or only the destination.
class ShiftRequest {
 public:
  /// @param text LATITUDE,LONGITUDE[,HEIGHT] in degrees and metres, once or FROM=TO.
  /// @throws UsageError.
  explicit ShiftRequest(const std::string& text);

  /// The shift, if the user gave both points.
  [[nodiscard]] std::optional<PlaceShift> shift() const;
  /// The shift that moves a geocentric point [m], finite, to the given destination. Without a
  /// height in the option, the point keeps its height.
  [[nodiscard]] PlaceShift shift_from(const Eigen::Vector3d& point) const;

 private:
  /// Angles [rad], height above the ellipsoid [m].
  struct Geodetic {
    double latitude = 0;
    double longitude = 0;
    std::optional<double> height;
  };
  static Geodetic parse(std::string_view text, const std::string& whole);
  [[nodiscard]] PlaceShift between(const Geodetic& from) const;

  std::optional<Geodetic> from_;
  Geodetic to_;
};

}  // namespace reckon::tools

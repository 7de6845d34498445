// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The place of a scene on Earth, and the entities that no device moves.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/pdu/codec/enumerations.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/settings/dead_reckoning_config.hpp"

namespace reckon::peer {

/// The point at which the scene's tangent frame S (east, north, up) touches the WGS84 ellipsoid.
struct OriginConfig {
  double latitude = 0.0;   ///< [rad], -pi/2 .. pi/2
  double longitude = 0.0;  ///< [rad], -pi .. pi
  double height = 0.0;     ///< [m] above the ellipsoid
};

/// Orientation as defined by DIS [rad].
struct Attitude {
  double heading = 0.0;  ///< clockwise from north, seen from above
  double pitch = 0.0;    ///< nose up positive
  double roll = 0.0;     ///< right side down positive
};

/// Unit quaternion, body (x forward, y right, z down) to S (x east, y north, z up).
[[nodiscard]] Eigen::Quaterniond orientation_of(const Attitude& attitude) noexcept;
/// The same for the axes of a device (x right, y forward, z up): all zero is the identity.
[[nodiscard]] Eigen::Quaterniond device_orientation_of(const Attitude& attitude) noexcept;

/// An entity that a peer owns, without a device: a vehicle, a post, a robot's tip.
struct EntityConfig {
  std::uint32_t peer = 1;  ///< number of the owning peer, from 1; others only see it
  std::string marking;     ///< at most 11 ASCII characters
  pdu::EntityType type{};  ///< numbers of SISO-REF-010
  pdu::ForceId force_id = pdu::ForceId::other;
  std::uint32_t appearance = 0;    ///< as on the wire; the peer sets deactivated and frozen
  std::uint32_t capabilities = 0;  ///< as on the wire
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] S; with a track: added to it
  /// Body (forward, right, down) to S; level, its nose to the north.
  Eigen::Quaterniond orientation = orientation_of({});
  std::filesystem::path track;  ///< CSV t_s,px_m,py_m,pz_m; absolute once loaded; empty: at rest
  double speed = 1.0;           ///< of the track; 2 is twice as fast; > 0
  std::optional<bool> repeat;   ///< of the track; none: true if its end equals its begin
  /// With a track: whether it turns, by the track's columns of orientation. Without such columns
  /// its nose points along the track, unless hands feel it.
  bool turns = true;
  DeadReckoningConfig dead_reckoning;           ///< as in docs/scene_files.md, [[entity]]
  std::optional<deadreckon::ForceModel> model;  ///< its model for hands, body axes
  double power = 0.05;  ///< [W] >= 0 that it may give to the hands that it pushes while it moves
  std::string beacon;   ///< name by which others find its cell; empty: none
};

}  // namespace reckon::peer

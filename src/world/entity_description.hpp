// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner's description of an entity (identity, accuracy of its updates, force model) and its
// true motion. A hand, a truck and a post are described in the same way.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/settings/dead_reckoning_config.hpp"

namespace reckon::peer {

/// Second half of an entity's ID at its owner: 1 .. 65534.
using EntityNumber = std::uint16_t;

/// Most entities that one peer can own: the numbers that IEEE 1278.1 leaves for them.
inline constexpr std::size_t kMostOwned = 65534;

/// The properties that do not change with the motion.
///
///   EntityDescription truck;
///   truck.marking = "TRUCK1";
///   truck.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
struct EntityDescription {
  std::string marking;  ///< at most 11 ASCII characters; longer ones are cut
  pdu::EntityType type{};
  pdu::ForceId force_id = pdu::ForceId::other;
  std::uint32_t appearance = 0;    ///< as on the wire; the peer itself sets frozen and deactivated
  std::uint32_t capabilities = 0;  ///< as on the wire
  /// Thresholds, model and heartbeat. Default: 1 m and 3 degrees as in IEEE 1278.1, RVW, and the
  /// heartbeat of the type.
  DeadReckoningConfig dead_reckoning = ordinary();
  /// Model of the force that hands of others and of this peer feel, body axes; none: no force.
  std::optional<deadreckon::ForceModel> model;
  /// Power [W] >= 0 that it may give to the hands that it pushes while it moves. It does not apply
  /// to an entity with a device, which gives the energy that its hand adds.
  double power = 0.05;
  /// Name by which others find its cell anywhere, valid by is_beacon_name; empty: none. No effect
  /// if the scene assigns no groups.
  std::string beacon = {};

  /// Settings of an entity of ordinary size; heartbeat 0 means the heartbeat of its type.
  [[nodiscard]] static DeadReckoningConfig ordinary();
};

/// True position and motion of an owned entity, scene frame S.
struct EntityTruth {
  std::chrono::nanoseconds time{0};                    ///< steady
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  /// Body (forward, right, down) to S (east, north, up): level, forward to the east.
  Eigen::Quaterniond orientation = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< [m/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();      ///< [m/s^2]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< [rad/s], body axes
  /// The part of the velocity to predict with, if that is not all of it (hands that touch). The
  /// entity is then sent as FPW, or as FVW if there is an acceleration.
  std::optional<Eigen::Vector3d> lasting_velocity = {};
};

}  // namespace reckon::peer

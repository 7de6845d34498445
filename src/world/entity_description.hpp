// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What an owner says of an entity (who it is, how exactly it is sent, what hands feel of it) and
// where it truly is. A hand, a truck and a post are described in the same words.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/scene/dead_reckoning_config.hpp"

namespace reckon::peer {

/// Second half of an entity's ID at its owner: 1 .. 65534.
using EntityNumber = std::uint16_t;

/// Most entities that one peer can own: the numbers that IEEE 1278.1 leaves for them.
inline constexpr std::size_t kMostOwned = 65534;

/// What does not change with the motion.
///
///   EntityDescription truck;
///   truck.marking = "TRUCK1";
///   truck.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
struct EntityDescription {
  std::string marking;  ///< at most 11 ASCII characters; longer ones are cut
  pdu::EntityType type{};
  pdu::ForceId force_id = pdu::ForceId::other;
  std::uint32_t appearance = 0;    ///< as on the wire; frozen and deactivated are the peer's own
  std::uint32_t capabilities = 0;  ///< as on the wire
  /// Thresholds, model and heartbeat. Default: 1 m and 3 degrees as in IEEE 1278.1, RVW, and the
  /// heartbeat of the type.
  DeadReckoningConfig dead_reckoning = ordinary();
  /// What hands of others and of this peer feel of it, body axes; none: nothing.
  std::optional<deadreckon::ForceModel> model;
  /// [W] >= 0 that it may give to hands which it pushes, while it moves. Not for an entity that a
  /// device moves: that one gives what its hand puts in.
  double power = 0.05;
  /// Name by which others find its cell wherever it goes, as is_beacon_name has it; empty: none.
  /// Nothing where the scene hands out no groups.
  std::string beacon = {};

  /// What an entity of ordinary size is sent with; heartbeat 0 = that of the type.
  [[nodiscard]] static DeadReckoningConfig ordinary();
};

/// Where an owned entity truly is and how it moves, scene frame S.
struct EntityTruth {
  std::chrono::nanoseconds time{0};                    ///< steady
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  /// Body (forward, right, down) to S (east, north, up): level, forward to the east.
  Eigen::Quaterniond orientation = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();          ///< [m/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();      ///< [m/s^2]
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< [rad/s], body axes
  /// What of the velocity is worth predicting, where that is not all of it (hands that touch); it
  /// is then sent as FPW, or with the acceleration, if there is one, as FVW.
  std::optional<Eigen::Vector3d> lasting_velocity = {};
};

}  // namespace reckon::peer

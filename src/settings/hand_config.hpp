// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force model of a hand, and what moves a simulated hand.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/haptics/scene/grab_spring.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

/// The force model that this peer's hand shows to others: a sphere that repels with F = k1 d + k3
/// d^3 - damping * d'.
struct HandModel {
  double radius = 0.02;         ///< [m] > 0; also the probe radius against remote hands
  double patch_radius = 0.0;    ///< [m] >= 0, of the patch that resists turning of bodies
  haptics::GrabSpring grab{};   ///< holds a body while the button is pressed
  double contact_radius = 0.0;  ///< [m] >= 0, of the sphere with which its device feels objects
  /// [N/m] >= 0; the receiver limits it to the stiffness that its device can show. The default,
  /// with its damper, is the limit of a device with default values.
  double k1 = 475.0;
  double k3 = 0.0;                ///< [N/m^3] >= 0
  double damping = 0.5;           ///< [N s/m] >= 0
  double static_friction = 0.4;   ///< coefficient >= kinetic_friction; 0 = none
  double kinetic_friction = 0.3;  ///< coefficient >= 0
  std::chrono::nanoseconds validity = std::chrono::seconds(12);  ///< the force fades out after this
};

/// `hand` as the force model to send: kind sphere, both points at the body's origin.
[[nodiscard]] inline deadreckon::ForceModel to_force_model(const HandModel& hand) {
  deadreckon::ForceModel model;
  model.kind = pdu::ForceModelKind::sphere;
  model.radius = hand.radius;
  model.k1 = hand.k1;
  model.k3 = hand.k3;
  model.damping = hand.damping;
  model.static_friction = hand.static_friction;
  model.kinetic_friction = hand.kinetic_friction;
  model.validity = pdu::to_seconds(hand.validity);
  return model;
}

/// Motion of a simulated hand.
enum class OperatorKind : std::uint8_t { passive, trace, sweep };

/// One simulated hand: a spring-damper (the grip) between the device and a moving target.
struct OperatorConfig {
  OperatorKind kind = OperatorKind::passive;
  std::filesystem::path trace;  ///< kind trace: CSV t_s,px_m,py_m,pz_m; absolute once loaded
  /// Kind trace: the recording is centred in this box [m] of S and scaled to fit; set by programs.
  std::optional<Eigen::AlignedBox3d> fit_to = {};
  double speed = 1.0;                 ///< kind trace: playback speed; 2 is twice as fast; > 0
  std::chrono::nanoseconds begin{0};  ///< kind trace: start within the recording, >= 0
  /// [m] S, kind trace: offset of its first position from the point of `begin`, which it reaches at
  /// `start`.
  Eigen::Vector3d approach = Eigen::Vector3d::Zero();
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] S: passive: held point; trace: added
  Eigen::Vector3d from = Eigen::Vector3d::Zero();      ///< [m] S: sweep: one end
  Eigen::Vector3d to = Eigen::Vector3d::Zero();        ///< [m] S: sweep: the other end
  std::chrono::nanoseconds period = std::chrono::seconds(2);  ///< sweep: time there and back, > 0
  bool grabs = false;  ///< sweep: on the way to `to` it presses button 0 of its device
  std::chrono::nanoseconds start{0};  ///< at rest until then, >= 0
  double stiffness = 300.0;           ///< [N/m] of the grip, >= 0
  double damping = 3.0;               ///< [N s/m] of the grip, >= 0
  /// For a device of six axes: rotation by the hand, about each axis of S.
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();  ///< [rad]; sweep: at `to`, none at `from`
  double turn_stiffness = 1.0;                       ///< [N m/rad] of the grip, >= 0
  double turn_damping = 0.02;                        ///< [N m s/rad] of the grip, >= 0
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A contact force as a few coefficients. The owner of a touchable entity sends them instead of
// forces, and each peer evaluates them against its own probe at servo rate.
//
// F = (k1 d + k3 d^3 - damping v.n) n for depth d > 0, never pulling. The spring part is the
// gradient of a potential that depends on position alone, so a slow closed path gains no energy.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::deadreckon {

/// One touchable feature of an entity, in its body axes.
///
/// Kinds: `plane` is the half-space below `point`, `normal` outwards. `sphere` has its centre at
/// `point`. `field` is a sphere that acts on the probe's centre, for any radius of the probe. A
/// `spring_damper_region` is a disc of a plane, of this radius around `point`: a peg with a flat
/// end and a rounded edge. `none` gives no force.
struct ForceModel {
  pdu::ForceModelKind kind = pdu::ForceModelKind::none;
  double k1 = 0;                                    ///< Stiffness [N/m], >= 0.
  double k3 = 0;                                    ///< Hardening [N/m^3], >= 0.
  double damping = 0;                               ///< Along the normal [N s/m], >= 0.
  double mass = 0;                                  ///< Of the entity [kg], >= 0; 0 = not stated.
  double static_friction = 0;                       ///< Coefficient, >= kinetic_friction.
  double kinetic_friction = 0;                      ///< Coefficient, >= 0.
  double restitution = 0;                           ///< 0 (plastic) to 1 (elastic).
  double radius = 0;                                ///< Of sphere, field or region [m], >= 0.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< Centre or contact point, body axes [m].
  Eigen::Vector3d normal = -Eigen::Vector3d::UnitZ();  ///< Outwards, body axes, unit (body up).
  std::uint16_t surface = 0;                           ///< Identity of the touched surface.
  std::uint16_t grip = 0;  ///< Stiffness of the spring that holds it [N/m]; 0: not stated.
  double validity = 0;  ///< Seconds for which the coefficients hold after the update.
};

/// Position and motion of a probe, which is a ball; reference axes.
struct ProbeState {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< Centre [m].
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s].
  double radius = 0;                                   ///< [m], >= 0.
};

/// Contact between a probe and a model, reference axes.
struct Contact {
  double depth = 0;                                   ///< Effective penetration [m]; > 0 inside.
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< Unit, from the entity towards the probe.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< The model's point (centre) [m].
  double slope = 1;  ///< Of depth against the normal, [0, 1]: share of f(depth) in the force.
};

/// Width [m] of the rounded edge of a region, at most half its radius.
inline constexpr double kEdgeWidth = 0.006;

/// Depth in a peg with a flat end, its slope, and the unit normal along which it decreases.
struct PegDepth {
  double depth = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double slope = 1;
};

/// The smaller of the depths under the face and under the side. Where they differ by less than the
/// edge's width, a parabola joins them. So depth is concave and smooth, its slope is at most 1, and
/// the force rotates continuously with the probe's path. @param face [m], depth under the face
/// @param reach [m], the peg's plus the probe's radius
/// @param normal of the face  @param lateral [m], from the axis to the probe
[[nodiscard]] PegDepth peg_depth(double face, double reach, const Eigen::Vector3d& normal,
                                 const Eigen::Vector3d& lateral) noexcept;

/// Depth and normal of a probe. Depth of kind `none` is -infinity. A probe exactly at the centre of
/// a sphere is pushed along the model's normal. Any thread, no allocation, about 30 ns.
[[nodiscard]] Contact contact(const ForceModel& model, const Pose& entity,
                              const Eigen::Vector3d& probe_position, double probe_radius) noexcept;

/// k1 d + k3 d^3 [N] for depth d > 0, else 0.
[[nodiscard]] constexpr double normal_force(double k1, double k3, double depth) noexcept {
  return depth > 0 ? depth * (k1 + k3 * depth * depth) : 0.0;
}

/// Energy [J] of the spring at this depth: the integral of normal_force from 0.
[[nodiscard]] constexpr double stored_energy(double k1, double k3, double depth) noexcept {
  return depth > 0 ? depth * depth * (0.5 * k1 + 0.25 * k3 * depth * depth) : 0.0;
}

/// dF/dd [N/m] at this depth: the stiffness of a local linear model.
[[nodiscard]] constexpr double tangent_stiffness(double k1, double k3, double depth) noexcept {
  return depth > 0 ? k1 + 3.0 * k3 * depth * depth : 0.0;
}

/// Force on the probe [N], reference axes, of the model as received, without friction. v.n is
/// relative to the entity's surface, which translates and rotates. Never pulls: the component along
/// the normal is >= 0. Zero outside and for NaN arguments. A received model must still pass a
/// passivity gate.
[[nodiscard]] Eigen::Vector3d evaluate(const ForceModel& model, const Pose& entity,
                                       const Eigen::Vector3d& probe_position,
                                       const Eigen::Vector3d& probe_velocity,
                                       double probe_radius) noexcept;

/// The same for a ProbeState.
[[nodiscard]] inline Eigen::Vector3d evaluate(const ForceModel& model, const Pose& entity,
                                              const ProbeState& probe) noexcept {
  return evaluate(model, entity, probe.position, probe.velocity, probe.radius);
}

}  // namespace reckon::deadreckon

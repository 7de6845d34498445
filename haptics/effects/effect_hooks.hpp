// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hooks of an effect in a servo step. An effect is a class with a table of parameters and at least
// one hook. Callers find the hooks only by these concepts.
//
//   cone()                       holds the surface contact point (SCP)
//   follow(place)                the same, with position and sliding speed of the SCP
//   spring_force(), stored_energy(), stiffness()   stores energy between device and SCP
//   force(contact), damping()    any other force on the device
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"

namespace reckon::haptics {

/// Motion of the SCP of a touched object.
struct SlidingPlace {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< [m], in the object's axes
  double slip = 0.0;                                ///< speed of the SCP on the surface [m/s], >= 0
  double dt = 0.001;                                ///< [s], since the last step
  double normal_force = 0.0;  ///< normal force of the object's springs [N] >= 0
  bool began = false;         ///< the contact began in the last step
  double depth = 0.0;         ///< [m] >= 0, depth of the device below the SCP, along the normal
};

/// The object's side of a contact.
struct ContactedObject {
  static constexpr std::uint32_t kNoTriangle = std::numeric_limits<std::uint32_t>::max();

  Eigen::Vector3d place = Eigen::Vector3d::Zero();     ///< the SCP in the object's axes [m]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< the object's axes -> S
  /// Velocity of the object at the SCP [m/s, S]; zero for static objects.
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  std::uint32_t triangle = kNoTriangle;  ///< of a mesh, below the SCP
  std::uint32_t patch = 0;               ///< of a mesh, number in SurfacePatches; 0: none
  bool began = false;                    ///< the contact is new in this step
  double gain = 1.0;                     ///< share of the springs that the device shows, [0, 1]
};

/// The contact with one object, as input of its effects, frame S.
struct EffectContact {
  Eigen::Vector3d device = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();       ///< [m]; the device point if free
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, out of the solid; zero if free
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the device [m/s]
  Eigen::Vector3d spring = Eigen::Vector3d::Zero();    ///< force of this object's springs [N]
  double depth = 0.0;                                  ///< |device - scp| [m]
  double dt = 0.001;                                   ///< [s], hold time of the force
  bool in_contact = false;
  /// Set while in contact, for objects that declare effects; null for effects that are always
  /// present.
  const ContactedObject* object = nullptr;
  /// Greatest coefficient of a force against slip() [N s/m]. With a higher one, a light body would
  /// reverse within dt, and the force with it, in each step. Infinite for static objects.
  double most_viscosity = std::numeric_limits<double>::infinity();

  /// Normal force of the springs [N] >= 0.
  [[nodiscard]] double normal_force() const noexcept { return std::max(spring.dot(normal), 0.0); }
  /// Velocity of the device relative to the object [m/s]; `object` is set.
  [[nodiscard]] Eigen::Vector3d relative() const noexcept { return velocity - object->velocity; }
  /// Its part along the surface [m/s].
  [[nodiscard]] Eigen::Vector3d slip() const noexcept {
    const Eigen::Vector3d over = relative();
    return over - normal.dot(over) * normal;
  }
};

/// Limits the motion of the SCP; at most one effect of an object may have this hook.
template <class Effect>
concept HoldsContactPoint = requires(Effect& effect) {
  { effect.cone() }
  noexcept->std::same_as<FrictionCone&>;
};

/// A cone that depends on the position: gets the position before the SCP moves.
template <class Effect>
concept FollowsPlace = HoldsContactPoint<Effect> &&
    requires(Effect& effect, const SlidingPlace& place) {
  { effect.follow(place) }
  noexcept->std::same_as<void>;
};

/// Stores energy: a function of |device - scp| that falls with it. Its force is the gradient of the
/// function and grows by at most stiffness() [N/m] per metre. The points [m] are in one frame, of
/// any choice.
template <class Effect>
concept StoresEnergy = requires(const Effect& effect, const Eigen::Vector3d& point) {
  { effect.spring_force(point, point) }
  noexcept->std::same_as<Eigen::Vector3d>;
  { effect.stored_energy(point, point) }
  noexcept->std::same_as<double>;
  { effect.stiffness() }
  noexcept->std::same_as<double>;
};

/// Gives any other force [N, S]. Called once a servo step, touched or not, except for effects that
/// are ActsInContactOnly. The force may have any value. It is shown as far as the contact's energy
/// ledger covers it (see StaticContact::load), and the sum never pulls a hand to the surface.
/// damping() [N s/m] is the part of the device's own damping that the effect reserves for its
/// ledger: for a damper its coefficient, else 0.
template <class Effect>
concept GivesForce = requires(Effect& effect, const Effect& fixed, const EffectContact& contact) {
  { effect.force(contact) }
  noexcept->std::same_as<Eigen::Vector3d>;
  { fixed.damping() }
  noexcept->std::same_as<double>;
};

/// Declares that force() is zero while the object is not touched, and need not be called then. An
/// effect without this is called in every step, at any distance of its object.
template <class Effect>
concept ActsInContactOnly = requires {
  requires Effect::kInContactOnly;
};

/// Present on every object that can be touched, with its defaults if it is not declared.
template <class Effect>
concept AlwaysThere = requires {
  requires Effect::kAlways;
};

/// Owns memory that its copies share and never change, so that a copy of it allocates nothing.
template <class Effect>
concept SharesMemory = requires {
  requires Effect::kSharesMemory;
};

/// Takes a file in addition to its numbers: kFile, and a path `file` in its Parameters.
template <class Effect>
concept TakesFile = requires {
  Effect::kFile.key;
};

/// Has a name, takes its parameters from its table, and can be copied for each contact without a
/// throw: it owns no memory, or shares it.
template <class Effect>
concept DescribedEffect = std::derived_from<Effect, CountedEffect<Effect>> &&
    std::constructible_from<Effect, const typename Effect::Parameters&> &&
    std::is_copy_assignable_v<Effect> &&(std::is_trivially_destructible_v<Effect> ||
                                         SharesMemory<Effect>)&&requires(const Effect& effect) {
  { Effect::kName } -> std::convertible_to<std::string_view>;
  { Effect::kKey } -> std::convertible_to<std::string_view>;
  { Effect::kCost } -> std::convertible_to<std::string_view>;
  requires std::same_as<typename std::remove_cvref_t<decltype(Effect::kParameters)>::value_type,
                        EffectParameter<typename Effect::Parameters>>;
  { effect.parameters() }
  noexcept->std::same_as<const typename Effect::Parameters&>;
};

/// Has at least one hook.
template <class Effect>
concept HookedEffect = HoldsContactPoint<Effect> || StoresEnergy<Effect> || GivesForce<Effect>;

/// Each hook that the effect names is complete and has the right types.
template <class Effect>
concept WholeHooks = (HoldsContactPoint<Effect> || !requires { &Effect::cone; }) &&
                     (FollowsPlace<Effect> || !requires { &Effect::follow; }) &&
                     (StoresEnergy<Effect> || !(
                                                  requires { &Effect::spring_force; } ||
                                                  requires { &Effect::stored_energy; } ||
                                                  requires { &Effect::stiffness; })) &&
                     (GivesForce<Effect> ||
                      !(
                          requires { &Effect::force; } || requires { &Effect::damping; }));

/// Hooks of an effect.
struct EffectHookSet {
  bool holds = false;            ///< HoldsContactPoint
  bool follows = false;          ///< FollowsPlace
  bool stores = false;           ///< StoresEnergy
  bool gives = false;            ///< GivesForce
  bool in_contact_only = false;  ///< ActsInContactOnly

  /// Order in a servo step: the contact point first, then springs, then the rest.
  [[nodiscard]] constexpr int turn() const noexcept { return holds ? 0 : (stores ? 1 : 2); }
};
inline constexpr int kTurns = 3;

template <class Effect>
inline constexpr EffectHookSet kHooks{HoldsContactPoint<Effect>, FollowsPlace<Effect>,
                                      StoresEnergy<Effect>, GivesForce<Effect>,
                                      ActsInContactOnly<Effect>};

/// Hooks of an effect: from its class, unless it has its own hooks().
template <class Effect>
[[nodiscard]] constexpr EffectHookSet hooks_of(const Effect& effect) noexcept {
  if constexpr (requires { effect.hooks(); }) {
    return effect.hooks();
  } else {
    return kHooks<Effect>;
  }
}

}  // namespace reckon::haptics

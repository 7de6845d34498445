// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What an effect may do in a servo step: its hooks. An effect is a class with a table of parameters
// and at least one hook; whoever runs effects finds them by these concepts alone.
//
//   cone()                                       holds the surface contact point (SCP)
//   spring_force(), stored_energy(), stiffness() stores energy between device and SCP
//   force(contact), damping()                    any other force on the device
#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <string_view>
#include <type_traits>

#include "reckon/haptics/effects/effect_parameter.hpp"
#include "reckon/haptics/geometry/friction_cone.hpp"

namespace reckon::haptics {

/// The contact with one object as its effects see it, frame S.
struct EffectContact {
  Eigen::Vector3d device = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();       ///< [m]; the device point when free
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, out of the solid; zero when free
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the device [m/s]
  Eigen::Vector3d spring = Eigen::Vector3d::Zero();    ///< force of this object's springs [N]
  double depth = 0.0;                                  ///< |device - scp| [m]
  double dt = 0.001;                                   ///< [s], the force is held so long
  bool in_contact = false;
};

/// Limits where the SCP goes, whoever moves it; at most one effect of an object may.
template <class Effect>
concept HoldsContactPoint = requires(Effect& effect) {
  { effect.cone() }
  noexcept->std::same_as<FrictionCone&>;
};

/// Stores energy: a function of |device - scp| that falls with it, whose force is its gradient and
/// grows by at most stiffness() [N/m] per metre. The points [m] are in one frame, no matter which.
template <class Effect>
concept StoresEnergy = requires(const Effect& effect, const Eigen::Vector3d& point) {
  { effect.spring_force(point, point) }
  noexcept->std::same_as<Eigen::Vector3d>;
  { effect.stored_energy(point, point) }
  noexcept->std::same_as<double>;
  { effect.stiffness() }
  noexcept->std::same_as<double>;
};

/// Gives any other force [N, S], asked for once a servo step, touched or not (but for those that
/// are ActsInContactOnly). It may be anything:
/// it is shown as far as the contact's energy ledger covers it (see StaticContact::render), and the
/// sum never pulls a hand to the surface. damping() [N s/m] is what the effect would have of the
/// device's own damping, for a damper its coefficient, else 0: what is reserved fills the ledger.
template <class Effect>
concept GivesForce = requires(Effect& effect, const Effect& fixed, const EffectContact& contact) {
  { effect.force(contact) }
  noexcept->std::same_as<Eigen::Vector3d>;
  { fixed.damping() }
  noexcept->std::same_as<double>;
};

/// Its force() is zero where its object is not touched: it need not be asked there. An effect that
/// does not say so is asked in every step, and so is an object that declares it, however far off.
template <class Effect>
concept ActsInContactOnly = requires {
  requires Effect::kInContactOnly;
};

/// Belongs to whatever can be touched, with its defaults where it is not declared.
template <class Effect>
concept AlwaysThere = requires {
  requires Effect::kAlways;
};

/// Says what it is, takes its parameters from its table, and is copied for each contact without
/// a throw.
template <class Effect>
concept DescribedEffect = std::derived_from<Effect, CountedEffect<Effect>> &&
    std::constructible_from<Effect, const typename Effect::Parameters&> &&
    std::is_nothrow_copy_assignable_v<Effect> && requires(const Effect& effect) {
  { Effect::kName } -> std::convertible_to<std::string_view>;
  { Effect::kKey } -> std::convertible_to<std::string_view>;
  { Effect::kCost } -> std::convertible_to<std::string_view>;
  requires std::same_as<typename std::remove_cvref_t<decltype(Effect::kParameters)>::value_type,
                        EffectParameter<typename Effect::Parameters>>;
  { effect.parameters() }
  noexcept->std::same_as<const typename Effect::Parameters&>;
};

/// Does something in a servo step.
template <class Effect>
concept HookedEffect = HoldsContactPoint<Effect> || StoresEnergy<Effect> || GivesForce<Effect>;

/// Each hook that it has a name of is there whole, with the right types.
template <class Effect>
concept WholeHooks = (HoldsContactPoint<Effect> || !requires { &Effect::cone; }) &&
                     (StoresEnergy<Effect> || !(
                                                  requires { &Effect::spring_force; } ||
                                                  requires { &Effect::stored_energy; } ||
                                                  requires { &Effect::stiffness; })) &&
                     (GivesForce<Effect> ||
                      !(
                          requires { &Effect::force; } || requires { &Effect::damping; }));

/// When in a servo step an effect has its turn: the contact point first, then springs, then the
/// rest.
inline constexpr int kTurns = 3;
template <class Effect>
inline constexpr int kTurn = HoldsContactPoint<Effect> ? 0 : (StoresEnergy<Effect> ? 1 : 2);

}  // namespace reckon::haptics

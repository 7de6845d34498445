// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A custom effect as the servo runs it. Nothing that its code answers reaches the energy ledger or
// the device unchecked.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/effects/effect_call_guard.hpp"
#include "reckon/haptics/effects/effect_custom.hpp"

namespace reckon::haptics {

/// Runs a custom effect and checks it in each step:
///
/// - An answer that is no number counts as zero. A force is cut to CallGuard::kMostForce.
/// - A spring is booked as long as it is what StoresEnergy asks for: a function of |device - scp|
///   that falls with it, whose gradient is its force and whose curvature is at most stiffness(). It
///   is tried at many depths when it is made, and about the present depth in each step. If it fails
///   once, its force is a held one from then on, which the energy port bounds without knowing it.
/// - An effect that is often slow is switched off, see CallGuard.
///
/// A copy has its own state and shares the report. Assignment between copies of one effect does not
/// allocate.
class GuardedEffect {
 public:
  static constexpr double kMostStiffness = 1e6;  ///< [N/m]
  static constexpr double kMostDamping = 1e4;    ///< [N s/m]
  static constexpr double kMostDepth = 0.05;     ///< [m], to which a spring is tried

  /// @param object its name, for the report
  /// @throws std::invalid_argument when the effect refuses its values, or reserves a damping that
  /// is no number from 0 to kMostDamping
  GuardedEffect(const DeclaredCustomEffect& declared, const std::string& object);
  GuardedEffect(const GuardedEffect& other);
  GuardedEffect(GuardedEffect&& other) noexcept = default;
  GuardedEffect& operator=(const GuardedEffect& other);
  GuardedEffect& operator=(GuardedEffect&& other) noexcept = default;
  ~GuardedEffect() = default;

  /// Of the effect; a spring may come to be held and so gives a force too.
  [[nodiscard]] EffectHookSet hooks() const noexcept {
    EffectHookSet hooks = effect_->hooks();
    hooks.in_contact_only |= !hooks.gives;
    hooks.gives |= hooks.stores;
    return hooks;
  }
  [[nodiscard]] const CustomObjectEffect& effect() const noexcept { return *effect_; }
  [[nodiscard]] std::span<const double> values() const noexcept { return *values_; }
  [[nodiscard]] const std::shared_ptr<GuardReport>& report() const noexcept {
    return guard_.shared_report();
  }

  /// Hook; only if hooks().holds.
  [[nodiscard]] FrictionCone& cone() noexcept { return *state_->cone(); }
  /// Hook: coefficients that are no numbers from 0 to 10 become 0.
  void follow(const SlidingPlace& place) noexcept;
  /// Hook; zero once the spring is held.
  [[nodiscard]] Eigen::Vector3d spring_force(const Eigen::Vector3d& scp,
                                             const Eigen::Vector3d& device) const noexcept;
  /// Hook; to be called after spring_force() with the same points.
  [[nodiscard]] double stored_energy(const Eigen::Vector3d& scp,
                                     const Eigen::Vector3d& device) const noexcept;
  /// Hook.
  [[nodiscard]] double stiffness() const noexcept;
  /// Hook; with the force of a spring that is held.
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) noexcept;
  /// Hook.
  [[nodiscard]] double damping() const noexcept { return damping_; }

 private:
  [[nodiscard]] bool is_potential_up_to(double depth) const noexcept;
  [[nodiscard]] bool is_potential_about(const Eigen::Vector3d& scp,
                                        const Eigen::Vector3d& device) const noexcept;
  [[nodiscard]] bool books() const noexcept {
    return effect_->hooks().stores && !held_ && !guard_.was_off();
  }
  void hold_spring() const noexcept;
  void mend_cone() noexcept;

  std::shared_ptr<const CustomObjectEffect> effect_;
  std::shared_ptr<const std::vector<double>> values_;
  std::unique_ptr<CustomEffectState> state_;
  double damping_ = 0.0;
  // Found while hooks that change nothing of the effect run.
  mutable CallGuard guard_;
  mutable bool held_ = false;
};

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a custom effect in the servo. Results of its code are checked before they reach the energy
// ledger or the device.
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
/// - A result that is not a number counts as zero. A force is limited to CallGuard::kMostForce.
/// - A spring is booked while it meets StoresEnergy: a function of |device - scp| that falls with
///   it, whose gradient is its force and whose curvature is at most stiffness(). It is tested at
///   many depths at construction, and around the present depth in each step. After a first failure
///   its force counts as a held force, which the energy port bounds for any effect.
/// - An effect that is often slow is switched off, see CallGuard.
///
/// A copy has its own state and shares the report. Assignment between copies of one effect does not
/// allocate.
class GuardedEffect {
 public:
  static constexpr double kMostStiffness = 1e6;  ///< [N/m]
  static constexpr double kMostDamping = 1e4;    ///< [N s/m]
  static constexpr double kMostDepth = 0.05;     ///< [m], greatest depth of the test of a spring

  /// @param object name, for the report
  /// @throws std::invalid_argument if the effect refuses its values, or reserves a damping outside
  /// 0 to kMostDamping
  GuardedEffect(const DeclaredCustomEffect& declared, const std::string& object);
  GuardedEffect(const GuardedEffect& other);
  GuardedEffect(GuardedEffect&& other) noexcept = default;
  GuardedEffect& operator=(const GuardedEffect& other);
  GuardedEffect& operator=(GuardedEffect&& other) noexcept = default;
  ~GuardedEffect() = default;

  /// Hooks of the effect; a spring counts as giving a force too, because it may become a held one.
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
  /// Hook: coefficients outside 0 to 10 become 0.
  void follow(const SlidingPlace& place) noexcept;
  /// Hook; zero once the spring has failed.
  [[nodiscard]] Eigen::Vector3d spring_force(const Eigen::Vector3d& scp,
                                             const Eigen::Vector3d& device) const noexcept;
  /// Hook; call after spring_force() with the same points.
  [[nodiscard]] double stored_energy(const Eigen::Vector3d& scp,
                                     const Eigen::Vector3d& device) const noexcept;
  /// Hook.
  [[nodiscard]] double stiffness() const noexcept;
  /// Hook; includes the force of a failed spring.
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
  // Mutable: const hooks update them.
  mutable CallGuard guard_;
  mutable bool held_ = false;
};

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A custom effect of a region as the servo runs it. Nothing that its code answers reaches the
// energy ledger or the device unchecked.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/effects/effect_call_guard.hpp"
#include "reckon/haptics/regions/region_custom.hpp"

namespace reckon::haptics {

/// Runs a custom effect of a region and checks it in each step:
///
/// - An answer that is no number counts as zero. A force is cut to CallGuard::kMostForce.
/// - A potential is booked as long as it is what StoresRegionEnergy asks for: nowhere below zero,
///   of a curvature of at most stiffness() and so never steeper than sqrt(2 stiffness energy), and
///   growing only by the work of the hand. It is tried on three ways of 0.2 m when it is made, and
///   on the hand's own way. If it fails once, its force is a held one from then on, which the
///   energy port bounds without knowing it.
/// - An effect that is often slow is switched off, see CallGuard.
///
/// What is booked never gives more than it stored, not even in the step in which it is found out:
/// a force of at most sqrt(2 stiffness energy) takes no more than the energy over any way, but for
/// 1/2 stiffness way^2, which is the device's to pay as for every spring.
///
/// A copy has its own state and shares the report. Assignment between copies of one effect does not
/// allocate.
class GuardedRegionEffect {
 public:
  static constexpr double kMostStiffness = 1e6;  ///< [N/m]
  static constexpr double kMostEnergy = 1e3;     ///< [J]; more would drown what others store

  /// @param region its name, for the report
  /// @throws std::invalid_argument when the effect refuses its values
  GuardedRegionEffect(const DeclaredCustomRegionEffect& declared, const std::string& region);
  GuardedRegionEffect(const GuardedRegionEffect& other);
  GuardedRegionEffect(GuardedRegionEffect&& other) noexcept = default;
  GuardedRegionEffect& operator=(const GuardedRegionEffect& other);
  GuardedRegionEffect& operator=(GuardedRegionEffect&& other) noexcept = default;
  ~GuardedRegionEffect() = default;

  [[nodiscard]] const CustomRegionEffect& effect() const noexcept { return *effect_; }
  [[nodiscard]] std::span<const double> values() const noexcept { return *values_; }
  [[nodiscard]] const std::shared_ptr<GuardReport>& report() const noexcept {
    return guard_.shared_report();
  }

  /// Hook; nothing once the potential is held.
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) noexcept;
  /// Hook.
  [[nodiscard]] double stiffness() const noexcept;
  /// Hook; with the force of a potential that is held. Called after potential().
  [[nodiscard]] Eigen::Vector3d force(const RegionPoint& point) noexcept;

 private:
  /// Where the potential was asked last.
  struct Last {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    RegionPotential answer{};
    bool known = false;
  };

  [[nodiscard]] bool books() const noexcept {
    return effect_->hooks().stores && !held_ && !guard_.was_off();
  }
  [[nodiscard]] bool acts_at(const RegionPoint& point) const noexcept {
    return point.inside || !effect_->hooks().inside_only;
  }
  [[nodiscard]] bool is_bounded(const RegionPotential& answer) const noexcept;
  [[nodiscard]] bool is_earned(const RegionPoint& point,
                               const RegionPotential& answer) const noexcept;
  void try_ways() noexcept;
  void hold_potential() noexcept;

  std::shared_ptr<const CustomRegionEffect> effect_;
  std::shared_ptr<const std::vector<double>> values_;
  std::unique_ptr<CustomRegionState> state_;
  CallGuard guard_;
  Last last_;
  bool held_ = false;
};

}  // namespace reckon::haptics

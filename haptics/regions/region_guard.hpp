// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs a custom effect of a region in the servo. Results of its code are checked before they reach
// the energy ledger or the device.
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
/// - A result that is not a number counts as zero. A force is limited to CallGuard::kMostForce.
/// - A potential is booked while it meets StoresRegionEnergy: it is never negative, its curvature
///   is at most stiffness(), so its slope at most sqrt(2 stiffness energy), and it grows only by
///   the work of the hand. It is tested on three lines of 0.2 m at construction, and on the path of
///   the hand. After a first failure its force counts as a held force, which the energy port bounds
///   for any effect.
/// - An effect that is often slow is switched off, see CallGuard.
///
/// A booked potential never gives more energy than it stored, not even in the step of its failure:
/// a force of at most sqrt(2 stiffness energy) takes at most that energy over any displacement,
/// plus 1/2 stiffness displacement^2, for which the device pays as for every spring.
///
/// A copy has its own state and shares the report. Assignment between copies of one effect does not
/// allocate.
class GuardedRegionEffect {
 public:
  static constexpr double kMostStiffness = 1e6;  ///< [N/m]
  static constexpr double kMostEnergy = 1e3;     ///< [J]; more would mask the energy of others

  /// @param region name, for the report
  /// @throws std::invalid_argument if the effect refuses its values
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

  /// Hook; empty once the potential has failed.
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) noexcept;
  /// Hook.
  [[nodiscard]] double stiffness() const noexcept;
  /// Hook; includes the force of a failed potential. Called after potential().
  [[nodiscard]] Eigen::Vector3d force(const RegionPoint& point) noexcept;

 private:
  /// The last call of the potential.
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

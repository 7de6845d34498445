// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Forces of the regions of a scene on a device. Their potentials are booked in full, like walls; if
// one begins above 0, the port's loan for regions pays for it. The ledger covers their other
// forces, and a separate bucket their oscillations.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// All regions of a plan. Each region's potential has a gain. It falls to the part that loan and
/// ledger cover, as when the hand enters a region that attracts it, and rises within 100 ms as they
/// pay. Order of calls within a step: move, settle, load, attenuate. One thread; allocates only at
/// construction.
class RegionForces {
 public:
  /// @param plan outlives this object  @param stiffness_cap [N/m] of all potentials together
  RegionForces(const EffectPlan& plan, double stiffness_cap);

  /// Sets the cap [N/m] from the next settle() on.
  void limit(double stiffness) noexcept { cap_ = stiffness; }

  /// Greatest energy of the potentials that regions supply, within the workspace of a device [J].
  /// @param space [m], in the device's axes @param to_scene from these to S
  [[nodiscard]] double range(const Eigen::AlignedBox3d& space,
                             const Eigen::Isometry3d& to_scene) const noexcept;

  /// Whether the plan has no regions; then no call is needed.
  [[nodiscard]] bool empty() const noexcept { return states_.empty(); }
  /// Restarts at `device` [m, S]: enters every region again, and its potential fades in.
  void reset(const Eigen::Vector3d& device) noexcept;
  /// Moves to `device` [m, S], and books the stored or released energy.
  void move(const Eigen::Vector3d& device, EnergyLedger& ledger) noexcept;
  /// Change of the potentials' force by that motion [N]; between move and settle.
  [[nodiscard]] Eigen::Vector3d change() noexcept;
  /// Lowers the gains for a debt, and raises them as the ledger pays. @param dt [s] of the last
  /// sample
  void settle(double dt, EnergyLedger& ledger) noexcept;
  /// Adds the forces to be held. @param velocity of the device [m/s, S] @param dt [s] of the next
  /// sample
  void load(const Eigen::Vector3d& velocity, double dt, PortLoad& load) noexcept;
  /// Takes the held share of the other forces, [0, 1].
  void shown(double extra) noexcept { shown_ = force_ + extra * held_; }
  /// Takes the held share of the oscillations, [0, 1].
  void shook(double share) noexcept { shown_ += share * shake_; }
  /// Scales the potentials and the force by `factor` in [0, 1]. The released energy repays the loan
  /// for regions, and the rest goes to the ledger.
  void attenuate(double factor, EnergyLedger& ledger) noexcept;

  /// The whole rendered force [N, S], after shown().
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return shown_; }
  [[nodiscard]] double stored() const noexcept;
  /// Least share of a potential that the ledger allows, [0, 1].
  [[nodiscard]] double share() const noexcept { return share_; }
  /// Force of the potentials without a lack of energy [N].
  [[nodiscard]] double asked() const noexcept { return asked_; }

 private:
  struct State {
    PlannedRegionEffects effects;
    RegionPoint point;
    RegionPotential sum{};     // sum of its potentials, in the region's axes
    RegionPotential source{};  // the part that the region supplies
    double gain = 0.0;
  };

  void enter(std::size_t index, const Eigen::Vector3d& device) noexcept;
  void move(State& state, const RegionPotential& before, const Eigen::Vector3d& way,
            EnergyLedger& ledger) noexcept;
  void sink(State& state, double dt, EnergyLedger& ledger) noexcept;
  void sum_up() noexcept;
  [[nodiscard]] double most_gain() const noexcept;
  static void lower(State& state, double factor, EnergyLedger& ledger) noexcept;
  static void scale_gain(State& state, double factor, EnergyLedger& ledger) noexcept;
  static bool raise_gain(State& state, double most, double dt, EnergyLedger& ledger) noexcept;

  const EffectPlan& plan_;
  std::vector<State> states_;
  bool has_sources_ = false;
  double cap_;
  bool begins_ = true;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();  // [N], of the potentials
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();   // [N], wanted by the others
  Eigen::Vector3d shake_ = Eigen::Vector3d::Zero();  // [N], wanted oscillations
  Eigen::Vector3d shown_ = Eigen::Vector3d::Zero();  // [N]
  double share_ = 1.0, asked_ = 0.0;
};

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a device feels of the regions of a scene. Their potentials are booked whole, as those of
// walls are; where one begins at more than 0, the port's loan for regions pays for it. Their other
// forces are held as far as the ledger covers them, and oscillations by their own bucket.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// All regions of a plan. Each region's potential is shown with a gain. It falls to what the loan
/// and the ledger cover where the potential would take more, as when the hand enters a region that
/// draws it in, and rises in 100 ms as they pay. Order of calls within a step: move, settle, load,
/// attenuate. One thread; allocates only at construction.
class RegionForces {
 public:
  /// @param plan outlives this object  @param stiffness_cap [N/m] of all potentials together
  RegionForces(const EffectPlan& plan, double stiffness_cap);

  /// From the next settle() on the cap is this [N/m].
  void limit(double stiffness) noexcept { cap_ = stiffness; }

  /// The most that the potentials that a region brings can store within the work space of a device
  /// [J]. @param space [m], in the device's axes  @param to_scene from these to S
  [[nodiscard]] double range(const Eigen::AlignedBox3d& space,
                             const Eigen::Isometry3d& to_scene) const noexcept;

  /// Whether the plan has none: nothing need be called then.
  [[nodiscard]] bool empty() const noexcept { return states_.empty(); }
  /// Restarts at `device` [m, S]: every region is entered anew, and its potential fades in.
  void reset(const Eigen::Vector3d& device) noexcept;
  /// Moves to `device` [m, S], and books what was stored or released.
  void move(const Eigen::Vector3d& device, EnergyLedger& ledger) noexcept;
  /// By how much that changed the force of the potentials [N]; between move and settle.
  [[nodiscard]] Eigen::Vector3d change() noexcept;
  /// Lowers the gains for a debt, and raises them as the ledger pays. @param dt [s], of the sample
  /// that ended
  void settle(double dt, EnergyLedger& ledger) noexcept;
  /// Adds the forces to be held. @param velocity of the device [m/s, S]  @param dt [s], of the next
  /// sample
  void load(const Eigen::Vector3d& velocity, double dt, PortLoad& load) noexcept;
  /// Takes the held share of the other forces, [0, 1].
  void shown(double extra) noexcept { shown_ = force_ + extra * held_; }
  /// Takes the share of the oscillations that is held besides, [0, 1].
  void shook(double share) noexcept { shown_ += share * shake_; }
  /// Scales the potentials, and the force, by `factor` in [0, 1]. What that releases repays the
  /// loan for regions, and the rest goes to the ledger.
  void attenuate(double factor, EnergyLedger& ledger) noexcept;

  /// The whole force that is shown [N, S], after shown().
  [[nodiscard]] const Eigen::Vector3d& force() const noexcept { return shown_; }
  [[nodiscard]] double stored() const noexcept;
  /// Least share of a potential that the ledger allows, [0, 1].
  [[nodiscard]] double share() const noexcept { return share_; }
  /// Force of the potentials if nothing were short [N].
  [[nodiscard]] double asked() const noexcept { return asked_; }

 private:
  struct State {
    PlannedRegionEffects effects;
    RegionPoint point;
    RegionPotential sum{};     // of its potentials, in the region's axes
    RegionPotential source{};  // of that, what the region brings
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

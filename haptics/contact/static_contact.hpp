// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The static scene at a device: the walls that the probes of its tool touch, and the regions around
// it.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "reckon/haptics/contact/grab.hpp"
#include "reckon/haptics/contact/region_forces.hpp"
#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/contact/wall_contact.hpp"
#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics {

/// Contact of each probe of a tool with all static objects and bodies, the bodies that the probes
/// hold, and the forces of all regions, which act at the first probe. The device's one port pays
/// for all. Order of calls within a step: settle, load, shown, attenuate.
/// @tparam axes of the device: 3, with a point for a tool, or 6
template <int axes>
class StaticContactOf {
 public:
  using Force = AxisForces<axes>;
  using Tool = ToolOf<axes>;
  using Port = EnergyPortOf<axes>;
  using Load = PortLoadOf<axes>;

  /// @param plan outlives this object @param stiffness_cap [N/m] of any object; regions together
  /// have a third of it in addition, see static_cap()
  /// @param radius of the probes [m], >= 0  @param probes of the tool, 1 or more
  StaticContactOf(const EffectPlan& plan, double stiffness_cap, double radius = 0.0,
                  std::size_t probes = 1);

  /// See ContactSolver, for all probes.
  void let_through_beyond(double force) noexcept {
    for (std::size_t i = 0; i < size(); ++i) walls_[i]->let_through_beyond(force);
  }
  [[nodiscard]] std::uint32_t passed() const noexcept {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < size(); ++i) sum += walls_[i]->passed();
    return sum;
  }
  /// Sets the state of a moving object, before settle(); see ContactSolver.
  void place(std::uint32_t body, const ObjectMotion& motion, const ObjectMotion& before) noexcept {
    for (std::size_t i = 0; i < size(); ++i) {
      walls_[i]->place(body, motion, before);
      if (grabs_[i].holds() && grabs_[i].body() == body) grabs_[i].place(motion);
    }
  }
  /// Sets whether a mover carries a moving object now.
  void set_carried(std::uint32_t body, bool is_carried) noexcept {
    for (std::size_t i = 0; i < size(); ++i) walls_[i]->set_carried(body, is_carried);
  }
  /// Sets the predicted change of the force of bodies' springs at a probe in the next sample [N];
  /// for the next load().
  void foresee(std::size_t probe, const Eigen::Vector3d& change) noexcept {
    walls_[probe]->foresee(change);
  }
  /// Sets the cap [N/m] from the next settle() on, at most the initial one.
  void limit(double stiffness) noexcept;
  /// Restarts at the tool's pose.
  void reset(const Tool& tool) noexcept;
  /// Follows the tool after a sample of `dt` [s], and books the stored or released energy.
  void settle(const Tool& tool, double dt, Port& port) noexcept;
  /// Adds the forces to be held: springs, and the effects' forces, which never pull.
  /// @param dt [s], of the next sample
  void load(const Tool& tool, double dt, Load& load) noexcept;
  /// The forces were cut to zero: touched objects fade in again.
  void drop() noexcept {
    for (std::size_t i = 0; i < size(); ++i) walls_[i]->drop();
  }
  /// Energy that the walls lack for their full storage while a loan is allowed [J]; else 0.
  [[nodiscard]] double lacks() const noexcept;
  /// Greatest hidden depth of a wall at a probe [m], see WallContact.
  [[nodiscard]] double hidden() const noexcept;
  /// Takes the held share of the effects' forces, [0, 1].
  void shown(double extra) noexcept;
  /// Scales forces and storage by `factor` in [0, 1].
  void attenuate(double factor, EnergyLedger& ledger) noexcept;
  /// Takes the held share of the regions' oscillations, [0, 1].
  void shook(double share) noexcept { regions_.shook(share); }

  /// Result of the probe that is deepest in an object; of the first without contact.
  [[nodiscard]] const ContactResult& result() const noexcept { return walls(deepest()).result(); }
  [[nodiscard]] std::size_t deepest() const noexcept { return axes == 3 ? 0 : deepest_; }
  [[nodiscard]] std::size_t probes() const noexcept { return size(); }
  /// Walls at a probe.
  [[nodiscard]] const WallContact& walls(std::size_t probe = 0) const noexcept {
    return *walls_[probe];
  }
  /// The grab of a probe.
  [[nodiscard]] Grab& grab(std::size_t probe) noexcept { return grabs_[probe]; }
  [[nodiscard]] const Grab& grab(std::size_t probe) const noexcept { return grabs_[probe]; }
  /// The first grab that holds a body; null: none.
  [[nodiscard]] const Grab* held() const noexcept {
    const auto holds = std::ranges::find_if(grabs_, &Grab::holds);
    return holds == grabs_.end() ? nullptr : &*holds;
  }
  [[nodiscard]] const RegionForces& regions() const noexcept { return regions_; }
  /// Storage of the springs of walls and grabs [J].
  [[nodiscard]] double stored() const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) sum += walls_[i]->stored() + grabs_[i].stored();
    return sum;
  }
  /// Whether a probe touches an object with a mass.
  [[nodiscard]] bool touches_body(const EffectPlan& plan) const noexcept;
  /// Whether a probe touches a body that another peer moves: a carried object with a mass.
  [[nodiscard]] bool touches_others_body(const EffectPlan& plan) const noexcept;
  /// Sum of walls and regions at all probes [N, S], after shown().
  [[nodiscard]] Eigen::Vector3d force() const noexcept;
  /// See WallContact, for all probes.
  [[nodiscard]] double carried() const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) sum += walls_[i]->carried();
    return sum;
  }
  /// Least share of the springs that the available energy allows, [0, 1].
  [[nodiscard]] double share() const noexcept;
  /// Force of the springs at the greatest stiffness that the device can render, all probes [N].
  [[nodiscard]] double asked() const noexcept;
  /// Force that the springs lack because their gain is below the cap.
  [[nodiscard]] Force held_back(const Tool& tool) const noexcept;

 private:
  static constexpr std::size_t kMost = axes == 3 ? 1 : kMostProbes;

  [[nodiscard]] std::size_t size() const noexcept { return axes == 3 ? 1 : size_; }
  void find_deepest() noexcept;

  std::array<std::optional<WallContact>, kMost> walls_;  // by probe
  std::array<Grab, kMost> grabs_;                        // by probe
  std::size_t size_ = 1;
  RegionForces regions_;
  std::size_t deepest_ = 0;
};

/// For a device of three axes, whose handle is its only probe.
using StaticContact = StaticContactOf<3>;

}  // namespace reckon::haptics

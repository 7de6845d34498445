// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Contact joints of ODE for one step, and their islands of bodies.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/island_energy.hpp"
#include "reckon/haptics/bodies/island_plan.hpp"
#include "reckon/haptics/bodies/ode_calls.hpp"

namespace reckon::haptics {

/// A body's data in ODE is its slot number. It allocates nothing after some steps. One thread.
class ContactJoints {
 public:
  /// @param world, energy outlive this
  ContactJoints(dWorldID world, IslandEnergy& energy);
  ~ContactJoints() { dJointGroupDestroy(joints_); }
  ContactJoints(const ContactJoints&) = delete;
  ContactJoints& operator=(const ContactJoints&) = delete;

  /// Begins a step without contacts.
  void begin() noexcept {
    clear();
    counts_.fill(0.0);
  }
  /// Removes all.
  void clear() noexcept;
  /// Finds and adds the contacts of two geoms, if one belongs to an awake body that is not carried.
  void meet(dGeomID a, dGeomID b) noexcept;
  enum class Hardness : std::uint8_t {
    usual,
    exact,  ///< for a step of Impacts::kInstant
  };
  /// Adds contacts of two geoms.
  void add(dGeomID a, dGeomID b, std::span<const dContactGeom> places,
           Hardness hardness = Hardness::usual) noexcept;
  /// Whether two geoms touch, in either order.
  [[nodiscard]] bool have_met(dGeomID a, dGeomID b) const noexcept;
  /// Removes the contacts, but keeps the islands.
  void remove() noexcept { dJointGroupEmpty(joints_); }

  [[nodiscard]] IslandEnergy::Islands& islands() noexcept { return islands_; }
  /// Slots of a body and of the carried body of another peer that it touches.
  [[nodiscard]] std::span<const std::pair<std::size_t, std::size_t>> met_carried() const noexcept {
    return met_carried_;
  }
  /// Contacts of a body in the last step, half of those with other moving bodies.
  [[nodiscard]] double contacts_of(std::size_t slot) const noexcept { return counts_[slot]; }
  /// Whether too many contacts are with carried objects. ODE treats all bodies that
  /// touch one carried object as one island, which would then be too large for the exact solver.
  [[nodiscard]] bool is_joined() const noexcept {
    return driven_.size() > static_cast<std::size_t>(IslandPlan::kMostExact);
  }
  /// Books the work that carried objects did in a step of dt [s].
  void book_driven(double dt) noexcept;

 private:
  // A contact of a body with a carried object.
  struct Driven {
    std::size_t slot = 0;
    bool is_second = false;  // the body is the joint's second one
    Eigen::Vector3d velocity =
        Eigen::Vector3d::Zero();  // [m/s], of the carried object at the contact
    dJointFeedback force{};
  };
  void note(dGeomID a, dGeomID b, std::span<const dContactGeom> places) noexcept;
  void note_driven(dJointID joint, dBodyID first, dBodyID second, const dContact& contact) noexcept;

  dWorldID world_;
  IslandEnergy& energy_;
  dJointGroupID joints_;
  IslandEnergy::Islands islands_;
  std::array<double, BodySlots::kMost> counts_{};
  std::vector<Driven> driven_;
  std::vector<std::pair<dGeomID, dGeomID>> met_;
  std::vector<std::pair<std::size_t, std::size_t>> met_carried_;
};

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The contacts of one step as the joints of ODE, and the islands of bodies that they make.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/island_energy.hpp"
#include "reckon/haptics/bodies/ode_calls.hpp"

namespace reckon::haptics {

/// The number of a body's slot is its data in ODE. After some steps it allocates nothing. One
/// thread.
class ContactJoints {
 public:
  /// Contacts of an island up to which the exact solver is the faster one. Beyond it takes their
  /// number to the third power, and mostly finds no answer.
  static constexpr int kMostExact = 24;

  /// @param world, energy outlive this
  ContactJoints(dWorldID world, IslandEnergy& energy);
  ~ContactJoints() { dJointGroupDestroy(joints_); }
  ContactJoints(const ContactJoints&) = delete;
  ContactJoints& operator=(const ContactJoints&) = delete;

  /// Removes all.
  void clear() noexcept;
  /// Finds and adds the contacts of two geoms, if one of them is of a body that is awake and moves.
  void meet(dGeomID a, dGeomID b) noexcept;
  enum class Hardness : std::uint8_t {
    usual,
    exact,  ///< for a step of an instant
  };
  /// Adds contacts of these two.
  void add(dGeomID a, dGeomID b, std::span<const dContactGeom> places,
           Hardness hardness = Hardness::usual) noexcept;
  /// Whether these two touch, in this order or the other.
  [[nodiscard]] bool have_met(dGeomID a, dGeomID b) const noexcept;
  /// Removes the contacts, but keeps what is known of the islands.
  void remove() noexcept { dJointGroupEmpty(joints_); }

  [[nodiscard]] IslandEnergy::Islands& islands() noexcept { return islands_; }
  /// Those of `some` whose island has more than kMostExact contacts.
  [[nodiscard]] BodySet crowded(BodySet some, const BodySlots& slots) noexcept;
  /// Whether more than kMostExact contacts are with carried objects. ODE treats all bodies that
  /// touch one carried object as one island, which would then be too large for the exact solver.
  [[nodiscard]] bool is_joined() const noexcept {
    return driven_.size() > static_cast<std::size_t>(kMostExact);
  }
  /// Books the work that carried objects did in a step of dt [s].
  void book_driven(double dt) noexcept;

 private:
  // A contact of a body with what is carried.
  struct Driven {
    std::size_t slot = 0;
    bool is_second = false;                              // it is the joint's second body
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // [m/s], of what is carried, there
    dJointFeedback force{};
  };
  void note(dBodyID first, dBodyID second, std::span<const dContactGeom> places) noexcept;
  void note_driven(dJointID joint, dBodyID first, dBodyID second, const dContact& contact) noexcept;

  dWorldID world_;
  IslandEnergy& energy_;
  dJointGroupID joints_;
  IslandEnergy::Islands islands_;
  std::vector<Driven> driven_;
  std::vector<std::pair<dGeomID, dGeomID>> met_;
};

}  // namespace reckon::haptics

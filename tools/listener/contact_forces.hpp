// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The contact forces that follow from a stream of PDUs: for every pair of haptic entities of a
// listener, the force model evaluated as by a peer that receives the same PDUs, before any
// receiver's gate.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <span>
#include <vector>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/tools/listener/listener.hpp"

namespace reckon::tools {

/// The force of one entity's model on the hand of another at one instant. It is not the force that
/// a hand felt: a receiver's gate may hold back some of it (docs/haptic_stability.md), and friction
/// is left out.
struct ContactForce {
  pdu::EntityId on;                                 ///< pushed entity
  pdu::EntityId by;                                 ///< owner of the model
  double depth = 0;                                 ///< [m], > 0
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N], east, north, up (S frame)
};

/// Change of a force by an update, at the instant of its arrival.
struct ForceJump {
  pdu::EntityId on;
  pdu::EntityId by;
  double size = 0;  ///< [N], length of the difference
};

/// The forces between the haptic entities of a listener (kPeerRules). One thread. Allocates as the
/// number of touching entities grows. A call costs about 0.1 us for each haptic entity, and a few
/// ns for each pair.
class ContactForces {
 public:
  /// All pairs that touch at `time`, in the order of the models' entities. Valid until the next
  /// call. A model whose validity has ended gives no force; call Listener::forget_silent() before.
  [[nodiscard]] std::span<const ContactForce> forces_at(const Listener& listener,
                                                        std::chrono::nanoseconds time);
  /// Sum of the forces on one entity [N], east, north, up; zero if there is none.
  [[nodiscard]] static Eigen::Vector3d force_on(const Listener& listener, const pdu::EntityId& id,
                                                std::chrono::nanoseconds time);
  /// The changes of force at `time` by the updates of the present datagram, for pairs that were
  /// known before; call it before Listener::end_datagram(). Valid until the next call.
  [[nodiscard]] std::span<const ForceJump> jumps_of_datagram(const Listener& listener,
                                                             std::chrono::nanoseconds time);

 private:
  /// A haptic entity with its pose at one instant.
  struct Placed {
    const pdu::EntityId* id;
    const deadreckon::ForceModel* model;
    deadreckon::Pose pose;
    deadreckon::ProbeState probe;
    bool is_probe;  // a sphere that others push
    bool is_valid;  // its model exerts a force
    double reach;   // [m] of the model about its point; infinite for planes
  };

  [[nodiscard]] static Placed place(const ReceivedEntity& entity, const ReceivedModel& model,
                                    std::chrono::nanoseconds time);
  [[nodiscard]] static bool may_touch(const Placed& on, const Placed& by);
  [[nodiscard]] static ContactForce between(const Placed& on, const Placed& by);
  void note_jumps(const Listener& listener, const TouchedEntity& touched,
                  std::chrono::nanoseconds time);

  std::vector<Placed> placed_;
  std::vector<ContactForce> forces_;
  std::vector<ForceJump> jumps_;
};

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data of one received entity: its newest state, the time of that state, and its force model.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/state_age.hpp"
#include "reckon/tools/listener/fixed_octets.hpp"
#include "reckon/tools/listener/update_pace.hpp"

namespace reckon::tools {

/// One entity, some 450 octets.
struct ReceivedEntity {
  static constexpr std::size_t kNoModel = ~std::size_t{0};

  std::uint64_t key = 0;  ///< entity_key; without the exercise if the rules ignore it
  pdu::EntityId id;
  std::uint8_t exercise = 0;
  bool has_state = false;     ///< a state was taken
  bool gone = false;          ///< it announced its end, or was removed
  std::uint64_t updates = 0;  ///< states taken
  FixedOctets octets{};       ///< of the last state: length 144, no variable parameters
  deadreckon::KinematicState state;
  std::chrono::nanoseconds state_time{};  ///< local time at which the state was valid
  std::chrono::nanoseconds arrival{};     ///< of that state; before any, of the last unusable one
  std::chrono::nanoseconds gone_at{};
  double heartbeat = 0;  ///< of the entity's kind [s]
  /// Age of the state [s] from which the entity is assumed at rest.
  double hold_after = std::numeric_limits<double>::infinity();
  UpdatePace pace;               ///< of its timestamps, with Timing::pace
  std::size_t model = kNoModel;  ///< index of its model

  [[nodiscard]] bool is_haptic() const noexcept { return model != kNoModel; }
  /// Seconds since `arrival`.
  [[nodiscard]] double age(std::chrono::nanoseconds now) const noexcept {
    return pdu::to_seconds(now - arrival);
  }
  /// Silent for more than 2.4 heartbeats of its kind, and not gone.
  [[nodiscard]] bool is_silent(std::chrono::nanoseconds now) const noexcept {
    return has_state && !gone && age(now) > deadreckon::timeout(heartbeat);
  }
  /// Dead reckoned pose, in the frame of the listener. A frozen entity is at rest.
  [[nodiscard]] deadreckon::Pose pose_at(std::chrono::nanoseconds time) const noexcept {
    const peer::StateAge age(time - state_time, hold_after, false);
    deadreckon::Pose pose = deadreckon::extrapolate(state, age.tau);
    age.hold(pose);
    return pose;
  }
  /// The last state as a PDU; its fields are 0 before the first.
  [[nodiscard]] pdu::EntityState entity_state() const noexcept {
    pdu::EntityState pdu;
    if (has_state) (void)decode(octets, pdu);
    return pdu;
  }
};

/// The force model of one entity.
struct ReceivedModel {
  std::size_t owner = 0;  ///< index of its entity
  deadreckon::ForceModel model;
  std::chrono::nanoseconds since{};  ///< arrival of its state

  /// The last instant of its validity.
  [[nodiscard]] std::chrono::nanoseconds valid_until() const noexcept {
    return since + pdu::from_seconds(model.validity);
  }
  /// A sphere or a field, which others push; planes and regions are not pushed.
  [[nodiscard]] bool is_probe() const noexcept {
    return model.kind == pdu::ForceModelKind::sphere || model.kind == pdu::ForceModelKind::field;
  }
  /// The probe that others push, of the entity at `pose`. The sphere of a hand is at its device:
  /// the model's point, not the body's origin (SCP).
  [[nodiscard]] deadreckon::ProbeState probe_at(const deadreckon::Pose& pose) const noexcept {
    const bool is_ball = model.kind == pdu::ForceModelKind::sphere;
    return {pose.position + pose.orientation * model.point, pose.velocity,
            is_ball ? model.radius : 0.0};
  }
};

}  // namespace reckon::tools

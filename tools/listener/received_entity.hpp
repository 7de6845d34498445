// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a listener knows of one entity: its newest state, when that was true, and its force model.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/tools/listener/fixed_octets.hpp"
#include "reckon/tools/listener/update_pace.hpp"

namespace reckon::tools {

/// One entity, some 450 octets.
struct ReceivedEntity {
  static constexpr std::size_t kNoModel = ~std::size_t{0};

  std::uint64_t key = 0;  ///< entity_key; without the exercise where the rules say so
  pdu::EntityId id;
  std::uint8_t exercise = 0;
  bool has_state = false;     ///< a state was taken
  bool gone = false;          ///< said that it leaves, or was removed
  std::uint64_t updates = 0;  ///< states taken
  FixedOctets octets{};       ///< of the last one: length 144, no variable parameters
  deadreckon::KinematicState state;
  std::chrono::nanoseconds state_time{};  ///< local time at which it was true
  std::chrono::nanoseconds arrival{};     ///< of that state; before any, of the last unusable one
  std::chrono::nanoseconds gone_at{};
  double heartbeat = 0;  ///< of the entity's kind [s]
  /// Age of the state [s] past which the entity is taken to stand still.
  double hold_after = std::numeric_limits<double>::infinity();
  UpdatePace pace;               ///< of its timestamps, where the rules lay states on time by it
  std::size_t model = kNoModel;  ///< place among the models

  [[nodiscard]] bool is_haptic() const noexcept { return model != kNoModel; }
  /// Seconds since `arrival`.
  [[nodiscard]] double age(std::chrono::nanoseconds now) const noexcept;
  /// Silent for more than 2.4 heartbeats of its kind, and not gone.
  [[nodiscard]] bool is_silent(std::chrono::nanoseconds now) const noexcept;
  /// Dead reckoned, in the frame of the listener. What is frozen has a model that stands still.
  [[nodiscard]] deadreckon::Pose pose_at(std::chrono::nanoseconds time) const noexcept;
  /// The last state as a PDU; its fields are 0 before the first.
  [[nodiscard]] pdu::EntityState entity_state() const noexcept;
};

/// The force model of one entity.
struct ReceivedModel {
  std::size_t owner = 0;  ///< place among the entities
  deadreckon::ForceModel model;
  std::chrono::nanoseconds since{};  ///< arrival of the state that it came with

  /// The last instant at which it is valid.
  [[nodiscard]] std::chrono::nanoseconds valid_until() const noexcept;
  /// A ball or a field, which others push; planes and regions are pushed by nobody.
  [[nodiscard]] bool is_probe() const noexcept;
  /// What others push, of the entity at `pose`. The ball of a hand is where its device is: the
  /// model's point, not the body's origin (SCP).
  [[nodiscard]] deadreckon::ProbeState probe_at(const deadreckon::Pose& pose) const noexcept;
};

}  // namespace reckon::tools

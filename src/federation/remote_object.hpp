// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A remote entity for a program.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

class RemoteCopy;
struct RemoteEntity;

/// One remote entity, scene frame S. Valid until the program's next step().
class RemoteObject {
 public:
  explicit RemoteObject(const RemoteCopy& copy) noexcept : copy_(&copy), row_(&copy.entity()) {}

  [[nodiscard]] const pdu::EntityId& id() const noexcept { return row_->id; }
  [[nodiscard]] const pdu::EntityType& type() const noexcept { return row_->type; }
  [[nodiscard]] std::string_view marking() const noexcept { return row_->marking.data(); }
  [[nodiscard]] pdu::ForceId force_id() const noexcept { return row_->force_id; }
  /// Appearance and capabilities as on the wire.
  [[nodiscard]] std::uint32_t appearance() const noexcept { return row_->appearance; }
  [[nodiscard]] std::uint32_t capabilities() const noexcept { return row_->capabilities; }
  [[nodiscard]] bool is_frozen() const noexcept { return row_->frozen; }

  /// Pose and velocity to show at `now` (steady time), converged. About 100 ns.
  [[nodiscard]] deadreckon::Pose shown(std::chrono::nanoseconds now) const noexcept {
    return copy_->shown(now);
  }
  /// Time since its last update was received.
  [[nodiscard]] std::chrono::nanoseconds age(std::chrono::nanoseconds now) const noexcept {
    return now - row_->last_heard;
  }
  /// The model of the force that hands feel, body axes; nullptr if it is not felt.
  [[nodiscard]] const deadreckon::ForceModel* force_model() const noexcept {
    return row_->haptic ? &row_->model : nullptr;
  }
  /// Updates received so far.
  [[nodiscard]] std::uint64_t updates() const noexcept { return row_->updates; }

 private:
  const RemoteCopy* copy_;
  const RemoteEntity* row_;
};

}  // namespace reckon::peer

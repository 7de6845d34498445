// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a program sees of the entities of others: a copy of each predictor on the program's own
// thread, so that it can ask for any pose at any instant while the loops go on.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/world/key_index.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// One entity of others, scene frame S. Good until the program's next step().
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
  /// Since its last update was heard.
  [[nodiscard]] std::chrono::nanoseconds age(std::chrono::nanoseconds now) const noexcept {
    return now - row_->last_heard;
  }
  /// What hands feel of it, body axes; nullptr for what is not felt.
  [[nodiscard]] const deadreckon::ForceModel* force_model() const noexcept {
    return row_->haptic ? &row_->model : nullptr;
  }
  /// Updates heard so far.
  [[nodiscard]] std::uint64_t updates() const noexcept { return row_->updates; }

 private:
  const RemoteCopy* copy_;
  const RemoteEntity* row_;
};

/// All of them. One thread, the program's; allocates as it grows.
class RemoteObjects {
 public:
  RemoteObjects() : index_(64) {}

  [[nodiscard]] const RemoteCopy* find(const pdu::EntityId& id) const noexcept;
  [[nodiscard]] std::span<const RemoteCopy> rows() const noexcept { return rows_; }
  /// Takes a copy; true where it was not there.
  bool put(const RemoteCopy& copy);
  /// False where it was not there.
  bool erase(const pdu::EntityId& id) noexcept;

 private:
  std::vector<RemoteCopy> rows_;  // dense
  KeyIndex index_;
};

}  // namespace reckon::peer

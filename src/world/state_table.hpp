// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What this peer knows of the entities of others: one row each, written by the model loop alone.
// Other threads see copies (PeerView), the servo sees its contact set.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/world/key_index.hpp"

namespace reckon::peer {

/// One remote entity: its pose and force predictors, and how it has behaved.
struct RemoteEntity {
  pdu::EntityId id;
  pdu::EntityType type;
  std::array<char, 12> marking{};  ///< ASCII, NUL at the end
  std::uint32_t epoch = 0;         ///< life of the owner's process; 0 = a peer without trailers

  deadreckon::KinematicState state;        ///< S frame, at state_time
  std::chrono::nanoseconds state_time{0};  ///< our steady time at which it was true
  std::chrono::nanoseconds last_heard{0};  ///< arrival of the last accepted update
  std::uint32_t timestamp = 0;             ///< as sent, for the order of updates
  deadreckon::PoseConvergence convergence{
      deadreckon::ConvergenceSettings{}};  ///< shown minus predicted, decaying
  bool adaptive = false;                   ///< what is shown follows `order`, not `state`
  deadreckon::AdaptiveOrder order;         ///< adaptive: history since the last abrupt change
  SenderClock clock;                       ///< from its timestamps to our time
  double timeout = 12.0;                   ///< [s] of silence after which the row is dropped
  bool frozen = false;

  static constexpr std::uint16_t kNoParts = 0xFFFF;
  std::uint16_t parts_place = kNoParts;  ///< in RemoteParts
  std::uint8_t parts = 0;                ///< numbers of its articulated parts, one or more a part

  bool haptic = false;                      ///< has sent a force model
  deadreckon::ForceModel model;             ///< body axes
  std::chrono::nanoseconds valid_until{0};  ///< then the force fades
  std::uint32_t version = 0;                ///< counts accepted updates

  double jump_m = 0.0;        ///< innovation of the last update: new against predicted position
  std::uint64_t updates = 0;  ///< accepted since the row was made
  std::chrono::nanoseconds first_heard{0};

  /// Pose by the predictor at `now`, without convergence.
  [[nodiscard]] deadreckon::Pose predicted(std::chrono::nanoseconds now) const noexcept;
  /// Pose that what is shown converges to: predicted(), or near it by `order` where adaptive.
  [[nodiscard]] deadreckon::Pose expected(std::chrono::nanoseconds now) const noexcept;
  /// Pose to show at `now`.
  [[nodiscard]] deadreckon::Pose shown(std::chrono::nanoseconds now) const noexcept;
};

/// Rows by entity ID. Fixed capacity: a flood of invented IDs cannot make it grow. One thread;
/// allocates only at construction. find() is O(1).
class StateTable {
 public:
  /// @param capacity rows, 1 .. 2^24; each about 1,400 octets.
  explicit StateTable(std::size_t capacity);

  [[nodiscard]] RemoteEntity* find(const pdu::EntityId& id) noexcept;
  [[nodiscard]] const RemoteEntity* find(const pdu::EntityId& id) const noexcept;
  /// The row of `id`, made empty when it is new; nullptr when the table is full.
  [[nodiscard]] RemoteEntity* find_or_add(const pdu::EntityId& id, bool& added) noexcept;
  /// Drops a row; nothing happens when there is none. Pointers to other rows become invalid.
  void erase(const pdu::EntityId& id) noexcept;

  /// All rows, in no order. Invalidated by find_or_add and erase.
  [[nodiscard]] std::span<RemoteEntity> rows() noexcept { return {rows_.data(), count_}; }
  [[nodiscard]] std::span<const RemoteEntity> rows() const noexcept {
    return {rows_.data(), count_};
  }
  [[nodiscard]] std::size_t capacity() const noexcept { return rows_.size(); }

 private:
  [[nodiscard]] static std::uint64_t key(const pdu::EntityId& id) noexcept;

  std::vector<RemoteEntity> rows_;  // dense, the first count_ are in use
  KeyIndex index_;
  std::size_t count_ = 0;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The remote entities that this peer knows: one row each, written only by the model loop. Other
// threads see copies (PeerView); the servo sees its contact set.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/world/key_index.hpp"
#include "reckon/peer/world/lazy_state.hpp"
#include "reckon/peer/world/row_column.hpp"

namespace reckon::peer {

/// The sender that has put an entity into the table.
struct Party {
  std::uint16_t host = 0;    ///< number of an address, while it has entities, see RowOwners
  std::uint16_t sender = 0;  ///< number of an address and port, while it has entities
  bool guest = true;         ///< a plain DIS program, not a peer

  friend bool operator==(const Party&, const Party&) = default;
};

/// One remote entity: its pose and force predictors, and its behaviour so far. A RemoteCopy
/// outlives the row.
struct RemoteEntity {
  pdu::EntityId id;
  pdu::EntityType type;
  std::array<char, 12> marking{};  ///< ASCII, NUL at the end
  pdu::ForceId force_id = pdu::ForceId::other;
  std::uint32_t appearance = 0;    ///< as on the wire
  std::uint32_t capabilities = 0;  ///< as on the wire
  std::uint32_t epoch = 0;         ///< of the owner's process; 0 = a peer without trailers

  LazyState state;                         ///< S frame, at state_time
  std::chrono::nanoseconds state_time{0};  ///< our steady time at which it was true
  std::chrono::nanoseconds last_heard{0};  ///< arrival of the last accepted update
  /// Since when its owner is silent for too long; the entity comes to rest from then on. kTrusted
  /// while the owner is received.
  std::chrono::nanoseconds doubted_at = kTrusted;
  /// Its force fades out from then on until a new state comes, because other datagrams of its owner
  /// do not prove its position. kTrusted if it was not doubted since its last state.
  std::chrono::nanoseconds felt_until = kTrusted;
  static constexpr std::chrono::nanoseconds kTrusted = std::chrono::nanoseconds::max();
  /// When it first pressed a hand of ours after its last state; kTrusted before.
  std::chrono::nanoseconds pressed_at = kTrusted;
  std::uint32_t timestamp = 0;  ///< as sent
  std::uint32_t version = 0;    ///< counts accepted updates

  static constexpr std::uint16_t kNoParts = 0xFFFF;
  std::uint16_t parts_place = kNoParts;  ///< in RemoteParts
  std::uint8_t parts = 0;  ///< parameters of its articulated parts, one or more for each part
  bool frozen = false;
  bool haptic = false;          ///< has sent a force model
  bool model_refused = false;   ///< its last model was refused
  bool strokes = false;         ///< a hand of a Reckon peer that states a change of speed
  std::uint8_t neighbours = 0;  ///< stated number of entities with which it exchanges energy

  deadreckon::ConvergingError convergence;  ///< shown minus predicted, decaying
  double timeout = 12.0;                    ///< [s] of silence after which the row is dropped
  /// In scenes with adaptive prediction: the shown pose follows the history since the last abrupt
  /// change, not `state`. Stored outside the table, valid as long as the row; else null.
  const deadreckon::AdaptiveOrder* order = nullptr;

  double jump_m = 0.0;        ///< innovation of the last update: new against predicted position
  std::uint64_t updates = 0;  ///< accepted since the row was made
  std::chrono::nanoseconds first_heard{0};

  // Last, because only felt entities have one: updates of others do not touch it.
  deadreckon::ForceModel model;             ///< body axes
  std::chrono::nanoseconds valid_until{0};  ///< the force fades from then on
  Party party;                              ///< set if there is a model

  /// Pose by the predictor at `now`, without convergence.
  [[nodiscard]] deadreckon::Pose predicted(std::chrono::nanoseconds now) const noexcept;
  /// Position [m] and velocity [m/s] of predicted(): no look, see LazyState.
  struct Motion {
    Eigen::Vector3d position, velocity;
  };
  [[nodiscard]] Motion motion(std::chrono::nanoseconds now) const noexcept;
  /// Pose to which the shown one converges: predicted(), or one near it by `order` if adaptive.
  [[nodiscard]] deadreckon::Pose expected(std::chrono::nanoseconds now) const noexcept;
  /// Pose to show at `now`.
  [[nodiscard]] deadreckon::Pose shown(std::chrono::nanoseconds now) const noexcept;

  /// The same two from the result of predicted() for this `now`, so that it is evaluated once.
  [[nodiscard]] deadreckon::Pose expected(const deadreckon::Pose& predicted,
                                          std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] deadreckon::Pose shown(const deadreckon::Pose& predicted,
                                       std::chrono::nanoseconds now) const noexcept;
};

/// A remote entity copied from its table, with all data on which its shown pose depends: a value
/// that another thread may keep.
class RemoteCopy {
 public:
  RemoteCopy() = default;
  explicit RemoteCopy(const RemoteEntity& row) noexcept;

  /// Its `order` is null in every scene: get poses from this copy, not from the entity.
  [[nodiscard]] const RemoteEntity& entity() const noexcept { return entity_; }
  /// Bit-identical to RemoteEntity::shown() of the row at the time of the copy.
  [[nodiscard]] deadreckon::Pose shown(std::chrono::nanoseconds now) const noexcept;

 private:
  RemoteEntity entity_;
  std::optional<deadreckon::AdaptiveOrder> order_;
};

/// Rows by entity ID. Fixed capacity: a flood of invented IDs cannot make it grow. One thread;
/// allocates only at construction, and memory is touched only as rows come. find() is O(1).
class StateTable {
 public:
  /// @param capacity rows, 1 .. 2^24.
  explicit StateTable(std::size_t capacity);

  [[nodiscard]] RemoteEntity* find(const pdu::EntityId& id) noexcept;
  [[nodiscard]] const RemoteEntity* find(const pdu::EntityId& id) const noexcept;
  /// Prefetches the memory that find(id) reads.
  void prefetch(const pdu::EntityId& id) const noexcept { index_.prefetch(id.key()); }
  /// Prefetches the memory that an update of this row touches, except its force model.
  static void prefetch_row(const RemoteEntity& row) noexcept;
  /// Prefetches its pose and force model for reading.
  static void prefetch_felt(const RemoteEntity& row) noexcept;
  /// The row of `id`; a new one is made empty at the end. Null if the table is full.
  [[nodiscard]] RemoteEntity* find_or_add(const pdu::EntityId& id, bool& added) noexcept;
  /// Drops the row at a place below rows().size(); the last row takes its place. Pointers to both
  /// become invalid.
  void erase(std::size_t place) noexcept;

  /// Place of a row of this table in rows().
  [[nodiscard]] std::size_t place_of(const RemoteEntity& row) const noexcept {
    return static_cast<std::size_t>(&row - rows_.all().data());
  }
  /// All rows, in no order. Invalidated by find_or_add and erase.
  [[nodiscard]] std::span<RemoteEntity> rows() noexcept { return rows_.all(); }
  [[nodiscard]] std::span<const RemoteEntity> rows() const noexcept { return rows_.all(); }
  [[nodiscard]] std::size_t capacity() const noexcept { return rows_.capacity(); }

 private:
  RowColumn<RemoteEntity> rows_;
  KeyIndex index_;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities outside the radius of interest, kept until they enter it. This is necessary because a
// resting entity sends an update only once a minute, and our own movement may bring it within the
// radius.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/due_column.hpp"
#include "reckon/peer/world/key_index.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/row_owners.hpp"

namespace reckon::peer {

/// The last update of an entity outside.
class OutsideEntity {
 public:
  /// Number of its articulated parts that are kept; all come with its next update.
  static constexpr std::size_t kParts = 6;

  OutsideEntity() = default;
  /// @param state the state of the update, S frame  @param timeout [s] of permitted silence
  OutsideEntity(const Inbound& update, const Arrival& arrival,
                const deadreckon::KinematicState& state, double timeout) noexcept;

  /// The update as it was. Its views are valid until this is moved or copied.
  [[nodiscard]] Inbound update() const noexcept;
  [[nodiscard]] const Arrival& arrival() const noexcept { return arrival_; }
  [[nodiscard]] const deadreckon::KinematicState& state() const noexcept { return state_; }
  [[nodiscard]] const pdu::EntityId& id() const noexcept { return pdu_.entity_id; }
  [[nodiscard]] const pdu::EntityType& type() const noexcept { return pdu_.entity_type; }
  /// Position [S] as if it had arrived at once: a position for checks, not for display.
  [[nodiscard]] Eigen::Vector3d position(std::chrono::nanoseconds now) const noexcept;
  /// Steady time; not before the time of the update.
  [[nodiscard]] std::chrono::nanoseconds last_heard() const noexcept { return last_heard_; }
  void set_last_heard(std::chrono::nanoseconds last_heard) noexcept { last_heard_ = last_heard; }
  /// [s] of permitted silence.
  [[nodiscard]] double timeout() const noexcept { return timeout_; }
  [[nodiscard]] bool is_silent(std::chrono::nanoseconds now) const noexcept;
  /// Sets a force model that arrived separately, or with the state before this one.
  void set_model(const pdu::HapticRecord& model) noexcept;
  void take_model_of(const OutsideEntity& former) noexcept;

 private:
  pdu::EntityState pdu_;  // without its parts
  std::array<std::byte, kParts * 16> parts_{};
  std::size_t parts_size_ = 0;
  pdu::HapticRecord model_;
  bool has_model_ = false;
  Arrival arrival_;
  std::chrono::nanoseconds last_heard_{0};
  deadreckon::KinematicState state_;
  double timeout_ = 0;
};

/// Entities by ID. One thread; allocates only at construction. Memory is touched as entities come,
/// some 700 octets each, and given back when most have gone. Further entities are not kept when it
/// is full: they appear with their next update.
class OutsideEntities {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Least and longest time before an entity is checked again.
  static constexpr Nanoseconds kSoonest = std::chrono::milliseconds(100);
  static constexpr Nanoseconds kLatest = std::chrono::seconds(1);
  /// [m/s] by which an entity may exceed its stated speed before a check is late.
  static constexpr double kSpareSpeed = 2.0;

  /// @param capacity most entities.
  explicit OutsideEntities(std::size_t capacity)
      : rows_(capacity), look_at_(capacity), places_(capacity), owners_(capacity) {}

  /// Stores the entity and replaces an earlier state of it.
  /// @param guest_room whether there is room for another entity of a plain DIS program; else it
  /// replaces one of the host that has the most, or is not kept
  void keep(const OutsideEntity& entity, bool guest_room = true) noexcept;
  /// Removes an entity of a plain DIS program, of the host that has the most; false if there is
  /// none.
  bool give_up_guest() noexcept;
  /// Records a datagram from this address. One look-up; does nothing if no entity of a plain DIS
  /// program is kept.
  void heard(const aoim::SourceAddress& from, Nanoseconds now) noexcept {
    if (guests() > 0) owners_.heard(from, now);
  }
  /// Address of the plain DIS program that owns this entity, as long as its permitted silence
  /// lasts; null if no such entity is kept under this ID.
  [[nodiscard]] const aoim::SourceAddress* guest_of(const pdu::EntityId& id,
                                                    Nanoseconds now) const noexcept;
  /// Entities of plain DIS programs.
  [[nodiscard]] std::size_t guests() const noexcept { return owners_.guests(); }
  void set_model(const pdu::EntityId& id, std::uint32_t epoch,
                 const pdu::HapticRecord& model) noexcept;
  void forget(const pdu::EntityId& id) noexcept;
  /// Removes those for which `is_gone(entity)` holds. Visits all.
  void forget_if(auto&& is_gone) {
    for (std::size_t i = 0; i < rows_.size();) {
      if (is_gone(rows_[i])) {
        erase(i);
      } else {
        ++i;
      }
    }
  }

  /// Calls visit(OutsideEntity) for all.
  void for_each(auto&& visit) const {
    for (const OutsideEntity& entity : rows_.all()) visit(entity);
  }

  /// Calls `gap(position)`, the distance [m] to the nearest place of interest, for the entities
  /// that are due. Calls enter(entity, last datagram of its owner) for each that is within, and
  /// removes it. Silent ones are removed, too.  @param speed [m/s] of that place
  void look(Nanoseconds now, double speed, auto&& gap, auto&& enter) {
    for (std::size_t i = look_at_.next_due(now, 0); i < rows_.size();
         i = look_at_.next_due(now, i)) {
      if (rows_[i].is_silent(now)) {
        erase(i);
        continue;
      }
      const double away = gap(rows_[i]);
      if (away > 0.0) {
        look_at_.set(i, now + patience(away, rows_[i].state().velocity.norm() + speed));
        continue;
      }
      const OutsideEntity entered = rows_[i];
      const Nanoseconds owner_heard = owners_.last_heard(i);
      erase(i);
      enter(entered, owner_heard);
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }

 private:
  /// Time for which an entity at this distance [m] and speed [m/s] needs no check.
  [[nodiscard]] static Nanoseconds patience(double away, double speed) noexcept;
  void erase(std::size_t place) noexcept;

  RowColumn<OutsideEntity> rows_;
  DueColumn look_at_;
  KeyIndex places_;
  RowOwners owners_;
};

}  // namespace reckon::peer

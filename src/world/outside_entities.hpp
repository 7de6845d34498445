// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What was heard of entities outside the radius of interest, kept until they come within: one that
// stands says so once a minute, and the one that moves may be we.
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
  /// Articulated parts kept of it; more come with its next update.
  static constexpr std::size_t kParts = 6;

  OutsideEntity() = default;
  /// @param state that of the update, S frame  @param timeout [s] of silence that it is owed
  OutsideEntity(const Inbound& update, const Arrival& arrival,
                const deadreckon::KinematicState& state, double timeout) noexcept;

  /// The update as it was; what it refers to is good while this is neither moved nor copied.
  [[nodiscard]] Inbound update() const noexcept;
  [[nodiscard]] const Arrival& arrival() const noexcept { return arrival_; }
  [[nodiscard]] const deadreckon::KinematicState& state() const noexcept { return state_; }
  [[nodiscard]] const pdu::EntityId& id() const noexcept { return pdu_.entity_id; }
  [[nodiscard]] const pdu::EntityType& type() const noexcept { return pdu_.entity_type; }
  /// [S], as if it had arrived at once: where it may be, not where it is shown.
  [[nodiscard]] Eigen::Vector3d position(std::chrono::nanoseconds now) const noexcept;
  /// Steady time; at the earliest that of the update.
  [[nodiscard]] std::chrono::nanoseconds last_heard() const noexcept { return last_heard_; }
  void set_last_heard(std::chrono::nanoseconds last_heard) noexcept { last_heard_ = last_heard; }
  /// [s] of silence that it is owed.
  [[nodiscard]] double timeout() const noexcept { return timeout_; }
  [[nodiscard]] bool is_silent(std::chrono::nanoseconds now) const noexcept;
  /// A force model that came alone, or with the state before this one.
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

/// By entity ID. One thread; allocates only at construction, memory is touched as entities come,
/// some 700 octets each, and given back when most have gone. Where it is full further ones are not
/// kept: they are seen with their next update.
class OutsideEntities {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Each is looked at again after so long at the earliest and at the latest.
  static constexpr Nanoseconds kSoonest = std::chrono::milliseconds(100);
  static constexpr Nanoseconds kLatest = std::chrono::seconds(1);
  /// [m/s] by which something may be faster than it says before it is late.
  static constexpr double kSpareSpeed = 2.0;

  /// @param capacity most entities.
  explicit OutsideEntities(std::size_t capacity)
      : rows_(capacity), look_at_(capacity), places_(capacity), owners_(capacity) {}

  /// Keeps it in place of what was kept of the same entity. @param guest_room whether there is room
  /// for one more of a plain DIS program; else another such goes, of the host that has the most, or
  /// this is not kept
  void keep(const OutsideEntity& entity, bool guest_room = true) noexcept;
  /// One of a plain DIS program makes room, of the host that has the most; false where none was
  /// found.
  bool give_up_guest() noexcept;
  /// Something came from there. One look-up; nothing where none of a plain DIS program is kept.
  void heard(const aoim::SourceAddress& from, Nanoseconds now) noexcept {
    if (guests() > 0) owners_.heard(from, now);
  }
  /// Where the plain DIS program whose entity this is speaks from, as long as it may be silent;
  /// null where none is kept under this ID.
  [[nodiscard]] const aoim::SourceAddress* guest_of(const pdu::EntityId& id,
                                                    Nanoseconds now) const noexcept;
  /// Those of plain DIS programs.
  [[nodiscard]] std::size_t guests() const noexcept { return owners_.guests(); }
  void set_model(const pdu::EntityId& id, std::uint32_t epoch,
                 const pdu::HapticRecord& model) noexcept;
  void forget(const pdu::EntityId& id) noexcept;
  /// Forgets those for which `is_gone(entity)` holds. Looks at all.
  template <typename Predicate>
  void forget_if(Predicate&& is_gone) {
    for (std::size_t i = 0; i < rows_.size();) {
      if (is_gone(rows_[i])) {
        erase(i);
      } else {
        ++i;
      }
    }
  }

  /// Calls visit(OutsideEntity) for all.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (const OutsideEntity& entity : rows_.all()) visit(entity);
  }

  /// Asks `gap(position)` of those whose instant has come: how far [m] they are from the nearest
  /// place of interest; calls enter(entity, when something came from its owner last) for each that
  /// is within, which is then forgotten; the silent are forgotten, too. @param speed [m/s] of that
  /// place
  template <typename Gap, typename Enter>
  void look(Nanoseconds now, double speed, Gap&& gap, Enter&& enter) {
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
  /// How long nothing at this distance [m] and speed [m/s] need be looked at.
  [[nodiscard]] static Nanoseconds patience(double away, double speed) noexcept;
  void erase(std::size_t place) noexcept;

  RowColumn<OutsideEntity> rows_;
  DueColumn look_at_;
  KeyIndex places_;
  RowOwners owners_;
};

}  // namespace reckon::peer

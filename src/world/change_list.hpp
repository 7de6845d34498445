// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Changes among the remote entities (new, changed, removed), for a copy of the table elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/peer/world/removal.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

enum class Change : std::uint8_t { discovered, updated, removed };

struct EntityChange {
  pdu::EntityId id;
  Change change = Change::updated;
  Removal cause = Removal::deactivated;  ///< of a removal
};

/// The changes of a table's rows between two calls of take(): at most one for each row and one for
/// each removed entity. It follows the table row by row, like a RowColumn. One thread; allocates
/// only at construction.
///
/// An entity that appears and disappears in between is not listed. One that disappears and returns
/// is listed as removed and then discovered.
class ChangeList {
 public:
  /// @param capacity rows of the table; 0 records nothing, and then every call is free.
  explicit ChangeList(std::size_t capacity) : noted_(capacity) {
    // At most the rows of the last take() can be removed.
    present_.reserve(capacity);
    gone_.reserve(capacity);
    taken_.reserve(2 * capacity);
  }

  /// A row was added at the end.
  void discovered() {
    if (noted_.capacity() == 0) return;
    noted_.push(kNone);
    note(noted_.size() - 1, Change::discovered);
  }
  /// The row at this place has changed.
  void updated(std::size_t place) noexcept {
    if (noted_.capacity() == 0 || noted_[place] != kNone) return;
    note(place, Change::updated);
  }
  /// The row of `id` at this place is removed, and the last row takes its place.
  void removed(std::size_t place, const pdu::EntityId& id, Removal cause) noexcept {
    if (noted_.capacity() == 0) return;
    const std::uint32_t entry = noted_[place];
    const bool untold = entry != kNone && present_[entry].change == Change::discovered;
    if (!untold) gone_.push_back({id, Change::removed, cause});
    if (entry != kNone) forget(entry);
    noted_.erase(place);
    if (place < noted_.size() && noted_[place] != kNone)
      present_[noted_[place]].row = static_cast<std::uint32_t>(place);
  }

  /// Takes all changes since the last call, in an order in which a copy can apply them; valid until
  /// the next call. @param rows the present rows of the table. Some ns a change.
  [[nodiscard]] std::span<const EntityChange> take(std::span<const RemoteEntity> rows) noexcept {
    // an entity that returns under an ID was removed under it before
    taken_.assign(gone_.begin(), gone_.end());
    for (const Present& present : present_) {
      taken_.push_back({rows[present.row].id, present.change});
      noted_[present.row] = kNone;
    }
    gone_.clear();
    present_.clear();
    return taken_;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  struct Present {
    std::uint32_t row = 0;
    Change change = Change::updated;
  };

  void note(std::size_t place, Change change) noexcept {
    noted_[place] = static_cast<std::uint32_t>(present_.size());
    present_.push_back({static_cast<std::uint32_t>(place), change});
  }
  void forget(std::uint32_t entry) noexcept {
    // Moves the last entry to the free place.
    present_[entry] = present_.back();
    noted_[present_[entry].row] = entry;
    present_.pop_back();
  }

  RowColumn<std::uint32_t> noted_;   // of each row: its place in present_, or kNone
  std::vector<Present> present_;     // new or changed rows
  std::vector<EntityChange> gone_;   // removed entities that were listed before
  std::vector<EntityChange> taken_;  // by the last take()
};

}  // namespace reckon::peer

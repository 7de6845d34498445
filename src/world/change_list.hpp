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
  explicit ChangeList(std::size_t capacity);

  /// A row was added at the end.
  void discovered();
  /// The row at this place has changed.
  void updated(std::size_t place) noexcept;
  /// The row of `id` at this place is removed, and the last row takes its place.
  void removed(std::size_t place, const pdu::EntityId& id, Removal cause) noexcept;

  /// Takes all changes since the last call, in an order in which a copy can apply them; valid until
  /// the next call. @param rows the present rows of the table. Some ns a change.
  [[nodiscard]] std::span<const EntityChange> take(std::span<const RemoteEntity> rows) noexcept;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  struct Present {
    std::uint32_t row = 0;
    Change change = Change::updated;
  };

  void note(std::size_t place, Change change) noexcept;
  void forget(std::uint32_t entry) noexcept;

  RowColumn<std::uint32_t> noted_;   // of each row: its place in present_, or kNone
  std::vector<Present> present_;     // new or changed rows
  std::vector<EntityChange> gone_;   // removed entities that were listed before
  std::vector<EntityChange> taken_;  // by the last take()
};

}  // namespace reckon::peer

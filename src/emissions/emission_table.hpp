// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The emitters, IFF systems and radios of all remote entities: one row each. Input is the PDUs of a
// network or a capture.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/peer/emissions/emission.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/row_column.hpp"
#include "reckon/peer/world/row_owners.hpp"

namespace reckon::peer {

/// Origin of a PDU about emissions.
struct EmissionSource {
  aoim::SourceAddress from;
  std::chrono::nanoseconds now{0};  ///< arrival; for a capture: its time
  bool guest = true;                ///< from a plain DIS program, or unknown
  bool owns = false;                ///< whether it owns the entity, see RemoteEntities::hear
};

/// Data not taken, since construction.
struct EmissionRefusals {
  std::uint64_t damaged = 0;   ///< PDUs
  std::uint64_t disputed = 0;  ///< states of a system whose row belongs to another host
  std::uint64_t no_room = 0;   ///< states of further systems

  [[nodiscard]] std::uint64_t all() const noexcept { return damaged + disputed + no_room; }
};

/// The table. One thread; allocates only at construction. Memory pages are used as rows are added,
/// 1.3 kB each. A system costs some 0.3 us.
///
/// A row is changed only by the host that made it, until it times out, or by the owner of the
/// entity. The owner's first PDU removes rows of other hosts. In a full table a row of the host
/// with the most rows is replaced, as in the table of entities (RowOwners).
///
/// The systems of an Electromagnetic Emission PDU replace the known systems with their numbers. In
/// a PDU with changed data (state update indicator 1) each beam replaces the beam with its number,
/// and other beams stay. A system sent without beams has none from then on. Systems that a PDU does
/// not name stay unchanged: a sender may use one PDU for each.
class EmissionTable {
 public:
  static constexpr std::size_t kRows = 1024;
  static constexpr std::size_t kRowsOfEntity = 16;

  /// @param rows limit of rows in total
  explicit EmissionTable(std::size_t rows = kRows);

  /// Takes one PDU; ignores other types.  @param octets any
  void take(std::span<const std::byte> octets, const EmissionSource& source) noexcept;
  /// Drops rows that have timed out. Some ns if there are none.
  void expire(std::chrono::nanoseconds now) noexcept;
  /// Drops the rows of all entities of a simulation.
  void drop(const pdu::SimulationAddress& simulation) noexcept;

  /// All rows, in no particular order. Valid until the next take, expire or drop.
  [[nodiscard]] std::span<const Emission> rows() const noexcept { return rows_.all(); }
  [[nodiscard]] const EmissionRefusals& refusals() const noexcept { return refusals_; }
  /// Sets EntityView::emits of each row.  @param entities in the order of their IDs
  void summarise(std::span<EntityView> entities) const noexcept;

 private:
  [[nodiscard]] bool read(std::span<const std::byte> octets, auto& pdu) noexcept;
  void take_emitters(const pdu::ElectromagneticEmission& pdu,
                     const EmissionSource& source) noexcept;
  void take_whole(const Emission& sent, const EmissionSource& source) noexcept;
  [[nodiscard]] Emission* find_or_add(const Emission& wanted,
                                      const EmissionSource& source) noexcept;
  [[nodiscard]] Emission* add(const Emission& wanted, const EmissionSource& source) noexcept;
  [[nodiscard]] bool make_room(const EmissionSource& source) noexcept;
  void update(Emission& row, const auto& state, std::chrono::nanoseconds now) noexcept;
  void drop_of_others(const pdu::EntityId& entity, const EmissionSource& source) noexcept;
  void erase(std::size_t place) noexcept;

  RowColumn<Emission> rows_;
  // Further columns, row by row.
  RowColumn<std::uint64_t> entities_;  // keys of the rows' entity IDs
  RowOwners owners_;
  std::chrono::nanoseconds next_over_ = std::chrono::nanoseconds::max();  // lower bound of the next
                                                                          // time-out
  EmissionRefusals refusals_;
};

}  // namespace reckon::peer

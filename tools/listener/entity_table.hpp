// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the view `top` knows of each entity: its last update, how often and why updates come, and
// how far the pose that receivers extrapolated was off when the next one came. No I/O; time is
// passed in.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/listener/entity_forces.hpp"
#include "reckon/tools/listener/jump_histogram.hpp"
#include "reckon/tools/listener/update_cause.hpp"

namespace reckon::tools {

/// One entity, some 1.5 kB.
struct EntityRow {
  static constexpr std::size_t kNoForce = ~std::size_t{0};

  std::uint64_t key = 0;  ///< entity_key
  pdu::EntityId id;
  std::uint8_t exercise = 0;
  bool gone = false;  ///< said that it leaves, or was removed
  bool has_state = false;
  bool last_is_bad = false;               ///< its last PDU could not be used
  UpdateCause cause = UpdateCause::none;  ///< of the last update
  std::array<std::uint32_t, kUpdateCauses> causes{};
  std::uint64_t updates = 0;  ///< used; `late` and `duplicated` ones not
  std::uint64_t late = 0;
  std::uint64_t duplicated = 0;
  std::uint64_t octets = 0;  ///< of all PDUs of this entity
  std::uint64_t bad = 0;     ///< PDUs that could not be used
  std::string_view rule;     ///< of the last bad one

  LastUpdate last;           ///< its octets are enough to filter by, and to show
  std::uint16_t length = 0;  ///< of that PDU, as its header had it
  std::uint64_t frame = 0;
  std::size_t pdu_index = 0;
  peer::IpEndpoint sender;
  peer::IpEndpoint group;
  std::chrono::nanoseconds gone_at{};
  double jump = 0;                 ///< the last one [m]
  std::array<float, 64> recent{};  ///< the last ones, a ring: the next goes to jumps.count() % 64
  JumpHistogram jumps;             ///< of the position, at each update [m]
  std::size_t force = kNoForce;    ///< place among the forces

  // Ends of the sliding window over which the rate is taken.
  std::array<std::chrono::nanoseconds, 2> window_time{};
  std::array<std::uint64_t, 2> window_updates{};

  [[nodiscard]] double age(std::chrono::nanoseconds now) const noexcept;
  /// Silent for more than 2.4 heartbeats of its kind, and not gone.
  [[nodiscard]] bool stale(std::chrono::nanoseconds now) const noexcept;
  /// Updates a second over the last 5 to 10 s, or over the last 4 to 8 updates where these took
  /// longer; falls while none comes. 0 before the second update.
  [[nodiscard]] double rate(std::chrono::nanoseconds now) const noexcept;
  /// The last jumps, at most 64, oldest first [m].
  [[nodiscard]] std::vector<double> recent_jumps() const;
  /// The last update as a PDU; its fields are 0 before the first.
  [[nodiscard]] pdu::EntityState entity_state() const noexcept;
};

/// All entities. One thread. Holds at most `most_rows`; what is about others is counted only.
/// Allocates for a new entity, never for a known one.
class EntityTable {
 public:
  static constexpr std::size_t kMostRows = std::size_t{1} << 16;
  /// Entities that left are still shown for so long.
  static constexpr std::chrono::nanoseconds kGoneShown = std::chrono::seconds(10);

  explicit EntityTable(std::size_t most_rows = kMostRows);

  /// Takes one PDU as the inspector found it, good or bad. Some 0.3 us for an Entity State.
  void take(const PduRow& row, const peer::SourceDatagram& datagram);
  /// Drops what has been gone for kGoneShown. Row numbers change.
  void drop_gone(std::chrono::nanoseconds now);

  [[nodiscard]] std::span<const EntityRow> rows() const noexcept { return rows_; }
  [[nodiscard]] const EntityRow* find(std::uint64_t key) const noexcept;
  /// PDUs of entities for which there was no room.
  [[nodiscard]] std::uint64_t others() const noexcept { return others_; }
  /// Its force model; null where it has none.
  [[nodiscard]] const EntityForce* force_of(const EntityRow& row) const noexcept;
  /// The largest force [N] that its model gives at the probe of another haptic entity.
  [[nodiscard]] double contact_force(const EntityRow& row, std::chrono::nanoseconds now) const;

 private:
  struct Update;  // one Entity State on its way in

  [[nodiscard]] EntityRow* row_of(std::uint8_t exercise, pdu::EntityId id);
  [[nodiscard]] EntityRow* known(const PduRow& row, pdu::EntityId id) noexcept;
  void index_all();
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept;
  void take_state(const PduRow& row, const peer::SourceDatagram& datagram);
  void take_state(EntityRow& entity, Update update);
  void take_state_update(const PduRow& row, const peer::SourceDatagram& datagram);
  void update(EntityRow& entity, const Update& update);
  void adopt(EntityRow& entity, const Update& update);
  void take_records(const PduRow& row, const peer::SourceDatagram& datagram);
  void take_record(EntityRow& entity, const pdu::HapticRecord& record,
                   std::chrono::nanoseconds arrival);
  void take_removal(const PduRow& row, const peer::SourceDatagram& datagram);
  void take_broken(const PduRow& row, const peer::SourceDatagram& datagram);
  [[nodiscard]] double seconds_of(std::chrono::nanoseconds time) const noexcept;

  std::size_t most_rows_;
  std::vector<EntityRow> rows_;
  std::vector<std::uint32_t> slots_;  // place of a row + 1; 0 = free; open addressing
  EntityForces forces_;
  std::uint64_t others_ = 0;
  std::optional<std::chrono::nanoseconds> start_;
};

}  // namespace reckon::tools

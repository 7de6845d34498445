// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counters of the view `top` for each entity of a listener: frequency and causes of updates, and
// the error of the extrapolated pose at the next update. No I/O; time is passed in.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/listener/entity_forces.hpp"
#include "reckon/tools/listener/jump_histogram.hpp"
#include "reckon/tools/listener/listener.hpp"
#include "reckon/tools/listener/update_cause.hpp"

namespace reckon::tools {

/// Counters of one entity in addition to the listener's state, some 1.7 kB.
struct EntityRow {
  bool last_is_bad = false;               ///< its last PDU was unusable
  UpdateCause cause = UpdateCause::none;  ///< of the last update
  std::array<std::uint32_t, kUpdateCauses> causes{};
  std::uint64_t late = 0;
  std::uint64_t duplicated = 0;
  std::uint64_t octets = 0;  ///< of all PDUs of this entity, including its compressed states
  std::uint64_t bad = 0;     ///< unusable PDUs
  std::string_view rule;     ///< violated by the last bad PDU

  std::uint16_t length = 0;  ///< of the last update's PDU, from its header
  std::uint64_t frame = 0;
  std::size_t pdu_index = 0;
  peer::IpEndpoint sender;
  peer::IpEndpoint group;
  double least_early_jump = 0;     ///< of updates before their heartbeat [m]; 0: none yet
  double jump = 0;                 ///< the last one [m]
  std::array<float, 64> recent{};  ///< last jumps, a ring: the next is written at jumps.count() %
                                   ///< 64
  JumpHistogram jumps;             ///< of the position, at each update [m]
  double turn = 0;                 ///< the last jump of the orientation [deg]
  JumpHistogram turns;             ///< of the orientation [deg]
  std::chrono::nanoseconds worst_time{};  ///< arrival of the update with the greatest jump
  std::uint64_t worst_frame = 0;          ///< of that update; 0: no jump yet

  // Ends of the sliding window for the rate.
  std::array<std::chrono::nanoseconds, 2> window_time{};
  std::array<std::uint64_t, 2> window_updates{};

  /// Updates per second of the row's entity over the last 5 to 10 s, or over the last 4 to 8
  /// updates if these took longer; decreases during silence. 0 before the second update.
  [[nodiscard]] double rate(const ReceivedEntity& entity,
                            std::chrono::nanoseconds now) const noexcept;
  /// The last jumps, at most 64, oldest first [m].
  [[nodiscard]] std::vector<double> recent_jumps() const;
};

/// All entities of a listener (kMonitorRules), each with its row. One thread. Holds at most
/// `most_rows`; PDUs of further entities are only counted. Allocates for a new entity, never for a
/// known one.
class EntityTable {
 public:
  static constexpr std::size_t kMostRows = kMonitorRules.most_entities;
  /// Entities that left are kept for this time.
  static constexpr std::chrono::nanoseconds kGoneShown = std::chrono::seconds(10);

  explicit EntityTable(std::size_t most_rows = kMostRows);

  /// Observer of each update that will be taken, called before the table changes.
  class Watch {
   public:
    virtual void before_state(const StateUpdate& update) = 0;
    virtual void before_model(const ReceivedEntity& entity, const ModelUpdate& update) = 0;

   protected:
    ~Watch() = default;
  };

  /// Takes one PDU with the inspector's result, good or bad. Some 0.3 us for an Entity State.
  void take_pdu(const PduRow& row, const peer::SourceDatagram& datagram, Watch* watch = nullptr);
  /// Drops entities that have been gone for kGoneShown. Row numbers change.
  void drop_gone(std::chrono::nanoseconds now);
  /// Drops entities that are silent past their time-out, or never had a readable state, and have
  /// been silent for `silence`. Row numbers change.
  void drop_silent(std::chrono::nanoseconds now, std::chrono::nanoseconds silence);

  [[nodiscard]] const Listener& listener() const noexcept { return listener_; }
  /// The listener's entities; rows() has the row of each at the same index.
  [[nodiscard]] std::span<const ReceivedEntity> entities() const noexcept {
    return listener_.entities();
  }
  [[nodiscard]] std::span<const EntityRow> rows() const noexcept { return rows_; }
  /// Arrival of the first datagram; 0 before it.
  [[nodiscard]] std::chrono::nanoseconds start() const noexcept {
    return start_.value_or(std::chrono::nanoseconds{});
  }
  /// PDUs of entities for which there was no room.
  [[nodiscard]] std::uint64_t others() const noexcept { return listener_.refusals().crowded; }
  /// Force changes of its model [N]; null if it has none.
  [[nodiscard]] const JumpHistogram* force_jumps(const ReceivedEntity& entity) const noexcept;
  /// The largest force [N] of its model at the probe of another haptic entity.
  [[nodiscard]] double contact_force(const ReceivedEntity& entity,
                                     std::chrono::nanoseconds now) const {
    return forces_.contact(listener_, entity, now);
  }

 private:
  struct Counting;  // handles one PDU

  [[nodiscard]] EntityRow& row_at(std::size_t place);
  void drop_where(auto&& is_over);

  Listener listener_;
  std::vector<EntityRow> rows_;
  EntityForces forces_;
  std::optional<std::chrono::nanoseconds> start_;
};

}  // namespace reckon::tools

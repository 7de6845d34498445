// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view `stats`: traffic by type and sender, fill of datagrams, loss by the sequence numbers in
// trailers, and the greatest jumps of entities.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "reckon/peer/network/link.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"
#include "reckon/tools/datagrams/traffic_totals.hpp"
#include "reckon/tools/datagrams/trailer_loss.hpp"
#include "reckon/tools/inspect/output/format.hpp"
#include "reckon/tools/inspect/output/view.hpp"
#include "reckon/tools/listener/entity_table.hpp"

namespace reckon::tools {

/// Sums of one row of the view.
struct TrafficShare {
  std::uint64_t pdus = 0;
  std::uint64_t octets = 0;     ///< of its PDUs; of broken ones the octets that are present
  std::uint64_t datagrams = 0;  ///< datagrams that contain it; senders and groups only
  std::uint64_t errors = 0;     ///< unreadable PDUs
  std::int64_t lost = 0;        ///< datagrams, from trailers; senders and groups only
};

/// Counts datagrams; one thread. Memory is bounded: each table has `most_rows` rows and one row
/// "others" for the rest.
class StatsView final : public View {
 public:
  static constexpr std::size_t kMostRows = std::size_t{1} << 16;

  /// `by`: "type", "sender", "group" or "entity" for a single, complete table. Empty for all
  /// tables, in text with at most 20 rows each.
  explicit StatsView(Format format, std::string by = {}, std::size_t most_rows = kMostRows);

  void pdu(const peer::SourceDatagram& datagram, const PduRow& row, std::chrono::nanoseconds start,
           std::string& out) override;
  void datagram(const peer::SourceDatagram& datagram, std::chrono::nanoseconds start,
                std::string& out) override;
  /// Writes all tables.
  void finish(const InspectTally& tally, std::string& out) override;

  [[nodiscard]] const TrafficTotals& totals() const { return totals_; }
  [[nodiscard]] const aoim::SequenceCounts& sequences() const { return loss_.counts(); }

 private:
  template <typename Key>
  struct Table {
    std::unordered_map<Key, TrafficShare> rows;
    TrafficShare others;
  };
  /// Greatest jumps of an entity from the prediction by its update before.
  struct Jumps {
    double metres = 0;
    double degrees = 0;
  };
  struct NamedShare {
    std::string key;
    TrafficShare share;
    std::optional<Jumps> jumps;  ///< of an entity that sent two states or more
  };
  using Rows = std::vector<NamedShare>;
  using EndpointTable = Table<peer::IpEndpoint>;

  template <typename Key>
  [[nodiscard]] TrafficShare& row_of(Table<Key>& table, const Key& key) const;
  [[nodiscard]] Rows rows(std::string_view by) const;
  [[nodiscard]] bool shows(std::string_view table) const { return by_.empty() || by_ == table; }
  void add_jumps(Rows& rows) const;
  void text(std::string& out) const;
  void text_table(std::string_view by, std::size_t most, std::string& out) const;
  void json_table(std::string_view by, std::string& out) const;
  void json_totals(std::string& out) const;
  void csv_table(std::string_view by, std::string& out) const;

  Format format_;
  std::string by_;
  std::size_t most_rows_;
  EntityTable motion_;
  TrafficTotals totals_;
  std::array<TrafficShare, 257> types_{};  // by PDU type; the last for PDUs without a header
  EndpointTable senders_;
  EndpointTable groups_;
  Table<pdu::EntityId> entities_;
  TrailerLoss loss_;
  TrafficShare datagram_;  // of the present datagram
};

}  // namespace reckon::tools

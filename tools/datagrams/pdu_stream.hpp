// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The PDUs of a capture in order, each with a copy of its octets, so that two captures can be
// compared.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/tools/datagrams/filter.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// A PDU that outlives its datagram.
struct HeldPdu {
  std::vector<std::byte> octets;
  std::uint64_t frame = 0;          ///< of its datagram, from 1
  std::size_t pdu = 0;              ///< place in the datagram, from 1
  std::size_t offset = 0;           ///< of its first octet in the datagram
  std::chrono::nanoseconds time{};  ///< arrival since 1970-01-01 UTC
  pdu::PduHeader header;
  bool has_header = false;
  bool decoded = false;
  bool ends_datagram = false;  ///< the last one of its datagram that passed the filter
  std::optional<pdu::EntityId> id;
  std::uint64_t hash = 0;  ///< of the compared octets

  /// Type as in the standard, snake case; "unreadable" without a header.
  [[nodiscard]] std::string_view type() const noexcept;
};

/// Selection from a capture, and the compared part of a PDU.
struct PduStreamOptions {
  std::string path;
  std::string where;         ///< filter; empty: all PDUs
  bool lenient = false;      ///< as DatagramInspector
  bool ignore_time = false;  ///< ignores times inside PDUs: header, trailer, Presence
};

/// A capture file, read once from begin to end. One thread.
class PduStream {
 public:
  /// @throws UsageError if the file cannot be read or the filter is invalid.
  explicit PduStream(const PduStreamOptions& options);

  /// The next PDU that passes the filter; false at the end.
  [[nodiscard]] bool next(HeldPdu& out);

  /// Counts of all PDUs so far, including PDUs that the filter excluded.
  [[nodiscard]] const InspectTally& tally() const { return inspector_.tally(); }
  /// Report of the source; `problem` if the file ended early.
  [[nodiscard]] const peer::SourceReport& report() const { return source_->report(); }

 private:
  bool read_datagram();
  void hold(const PduRow& row);

  bool ignore_time_;
  std::optional<Filter> filter_;
  std::unique_ptr<peer::DatagramSource> source_;
  DatagramInspector inspector_;
  std::deque<HeldPdu> queue_;
};

/// Whether the two are equal octet for octet, except for ignored times.
[[nodiscard]] bool same_octets(const HeldPdu& a, const HeldPdu& b, bool ignore_time);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Content of a capture: counts by type, sender, group, entity and fault.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// A count, and its octets.
struct Share {
  std::uint64_t count = 0;
  std::uint64_t octets = 0;
  void add(std::size_t size) {
    ++count;
    octets += size;
  }
};

/// One entity of the capture; times since the first datagram.
struct EntityShare {
  Share pdus;
  std::string marking;
  std::chrono::nanoseconds first{};
  std::chrono::nanoseconds last{};
};

/// A rule that PDUs break.
struct RuleShare {
  std::uint64_t count = 0;
  std::uint64_t first_frame = 0;
};

/// Counts datagrams and their PDUs. Memory grows with the number of different keys, not with the
/// length of the capture.
class CaptureSummary {
 public:
  /// @param lenient as DatagramInspector
  explicit CaptureSummary(bool lenient = false) : inspector_(lenient) {}

  void add(const peer::SourceDatagram& datagram);

  std::optional<std::chrono::nanoseconds> first;  ///< least time, since 1970-01-01 UTC
  std::optional<std::chrono::nanoseconds> last;   ///< greatest time
  Share datagrams;
  std::map<std::string, Share> types;  ///< by the name of inspect --json
  std::map<peer::IpEndpoint, Share> senders;
  std::map<peer::GroupAddress, Share> groups;
  std::map<pdu::EntityId, EntityShare> entities;
  std::map<std::string, RuleShare> rules;

  [[nodiscard]] const InspectTally& tally() const { return inspector_.tally(); }
  /// Between the first and the last datagram [s].
  [[nodiscard]] double seconds() const;

 private:
  void add_pdu(const PduRow& row);

  DatagramInspector inspector_;
};

/// The summary as text tables.
[[nodiscard]] std::string summary_text(const std::string& name, const CaptureSummary& summary,
                                       const peer::SourceReport& report);
/// The same without a limit, as one JSON object on one line.
[[nodiscard]] std::string summary_json(const std::string& name, const CaptureSummary& summary,
                                       const peer::SourceReport& report);

}  // namespace reckon::tools

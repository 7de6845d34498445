// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Lost datagrams, from the sequence numbers in trailers.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// Tracks the trailers of up to 4096 pairs of sender and group; one thread.
class TrailerLoss {
 public:
  /// Takes a PDU of the present datagram; ignores PDUs other than trailers.
  void pdu(const PduRow& row);
  /// Ends the datagram. Returns the increase of the number of lost datagrams; negative for a late
  /// datagram, 0 without a trailer.
  std::int64_t datagram(const peer::SourceDatagram& datagram);
  [[nodiscard]] const aoim::SequenceCounts& counts() const { return sequences_.counts(); }

 private:
  /// Destination, and the group in a unicast frame; -1 without one.
  using Place = std::pair<peer::IpEndpoint, std::int32_t>;
  [[nodiscard]] aoim::GroupIndex index_of(const Place& place);

  aoim::SequenceTracker sequences_;
  std::map<Place, std::uint16_t> group_indices_;
  std::int32_t said_ = -1;
  bool has_trailer_ = false;
  std::uint32_t epoch_ = 0;
  std::uint32_t sequence_ = 0;
};

}  // namespace reckon::tools

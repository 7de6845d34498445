// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams that were lost on the way, from the sequence numbers in trailers.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {

/// Follows the trailers of up to 4096 pairs of sender and group; one thread.
class TrailerLoss {
 public:
  /// A PDU of the datagram at hand; those that are no trailer are left.
  void pdu(const PduRow& row);
  /// Ends the datagram: by how many the lost ones are more than before it. A late one makes them
  /// fewer. 0 where it had no trailer.
  std::int64_t datagram(const peer::SourceDatagram& datagram);
  [[nodiscard]] const aoim::SequenceCounts& counts() const { return sequences_.counts(); }

 private:
  /// Where it went, and the group that a unicast frame says; -1 without one.
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

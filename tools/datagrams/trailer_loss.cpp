// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/trailer_loss.hpp"

#include <algorithm>
#include <utility>

#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/reckon/unicast_frame.hpp"

namespace reckon::tools {
namespace {

/// Groups beyond the limit share one number, so their losses are not distinguished.
constexpr std::size_t kSharedIndex = 0xFFFE;

}  // namespace

void TrailerLoss::pdu(const PduRow& row) {
  if (row.decoded && row.header.pdu_type == pdu::PduType::unicast_frame) {
    if (const auto frame = pdu::unicast_frame_of(row.bytes)) said_ = frame->group;
    return;
  }
  if (!row.decoded || row.header.pdu_type != pdu::PduType::datagram_trailer) return;
  pdu::DatagramTrailer trailer;
  if (decode(row.bytes, trailer) != pdu::DecodeError::none) return;
  has_trailer_ = true;
  epoch_ = trailer.epoch;
  sequence_ = trailer.sequence;
}

aoim::GroupIndex TrailerLoss::index_of(const Place& place) {
  const auto known = group_indices_.find(place);
  std::size_t index = known != group_indices_.end() ? known->second : group_indices_.size();
  index = std::min<std::size_t>(index, kSharedIndex);
  if (known == group_indices_.end() && index < kSharedIndex)
    group_indices_[place] = static_cast<std::uint16_t>(index);
  return aoim::GroupIndex{static_cast<std::uint16_t>(index)};
}

std::int64_t TrailerLoss::datagram(const peer::SourceDatagram& datagram) {
  const std::int32_t said = std::exchange(said_, -1);
  if (!has_trailer_) return 0;
  has_trailer_ = false;
  const auto before = static_cast<std::int64_t>(counts().lost);
  (void)sequences_.note(epoch_, index_of({datagram.group, said}), sequence_);
  return static_cast<std::int64_t>(counts().lost) - before;
}

}  // namespace reckon::tools

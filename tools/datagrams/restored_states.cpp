// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/restored_states.hpp"

#include <string_view>

namespace reckon::tools {
namespace {

std::string_view reason_of(peer::RestoreVerdict verdict) {
  return verdict == peer::RestoreVerdict::awaits_key
             ? "cannot be restored: its key, an earlier plain or compact state, is missing"
             : "cannot be restored: its octets do not have this format";
}

std::size_t number_of(const pdu::CompressedStates& states) {
  std::size_t count = 0;
  pdu::CompressedStateReader reader(states);
  for (pdu::CompressedState one; count < RestoredStates::kMost && reader.next(one);) ++count;
  return count;
}

}  // namespace

const std::vector<RestoredState>& RestoredStates::restore(const pdu::CompressedStates& states,
                                                          const PduRow& around) {
  const std::size_t count = number_of(states);
  states_.resize(count);
  if (rooms_.size() < count) rooms_.resize(count);
  pdu::CompressedStateReader reader(states);
  pdu::CompressedState one;
  for (std::size_t i = 0; i < count && reader.next(one); ++i) {
    RestoredState& out = states_[i];
    out.form = one.form;
    out.octets = pdu::kCompressedHeadSize + one.body.size();
    out.row = PduRow{};
    out.row.frame = around.frame;
    out.row.time = around.time;
    out.row.start = around.start;
    out.row.pdu = around.pdu;
    out.row.interface = around.interface;
    out.row.offset = around.offset +
                     static_cast<std::size_t>(one.body.data() - around.bytes.data()) -
                     pdu::kCompressedHeadSize;
    out.row.id = {states.simulation.site, states.simulation.application, one.entity};
    fill(states, one, rooms_[i], out.row);
  }
  return states_;
}

void RestoredStates::fill(const pdu::CompressedStates& states, const pdu::CompressedState& state,
                          Room& room, PduRow& row) {
  peer::RestoreVerdict verdict = keys_.restore(states, state, room.state);
  if (verdict == peer::RestoreVerdict::good &&
      (encode(room.state, room.octets) != room.octets.size() ||
       decode_header(room.octets, row.header) != pdu::DecodeError::none))
    verdict = peer::RestoreVerdict::malformed;
  row.has_header = row.decoded = verdict == peer::RestoreVerdict::good;
  if (!row.decoded) {
    row.reason = reason_of(verdict);
    return;
  }
  row.bytes = room.octets;
  row.entity_state = &room.state;
}

}  // namespace reckon::tools

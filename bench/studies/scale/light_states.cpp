// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/light_states.hpp"

#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/codec/codec.hpp"

namespace reckon::bench {

LightStates::LightStates(Crowd& crowd, std::span<const OwnedRange> ranges) : crowd_(crowd) {
  ids_.reserve(crowd.size());
  for (std::size_t peer = 0; peer < ranges.size(); ++peer) {
    for (std::uint32_t e = ranges[peer].first; e < ranges[peer].end; ++e)
      ids_.push_back({1, static_cast<std::uint16_t>(peer + 1),
                      static_cast<std::uint16_t>(e - ranges[peer].first + 1)});
  }
}

deadreckon::KinematicState LightStates::state_of(std::uint32_t entity) const {
  const auto algorithm = crowd_.moves(entity) ? pdu::DeadReckoningAlgorithm::rvw
                                              : pdu::DeadReckoningAlgorithm::static_;
  return kinematic_state(crowd_.motion(entity), algorithm);
}

bool LightStates::encode(std::uint32_t entity, pdu::EntityState& pdu) const {
  pdu.entity_id = id_of(entity);
  pdu.entity_type.kind = pdu::EntityKind::platform;
  return to_wire(state_of(entity), frame_, pdu) == deadreckon::ConversionError::none;
}

bool LightStates::decode(const pdu::EntityState& pdu, deadreckon::KinematicState& state) const {
  return from_wire(pdu, frame_, state) == deadreckon::ConversionError::none;
}

LightStates::Compressed LightStates::compress(std::uint32_t entity, const LightEntity& owned,
                                              const pdu::EntityState& pdu, const LightAddress& to,
                                              deadreckon::SendReason reason, std::size_t near_rows,
                                              std::chrono::nanoseconds now) {
  if (told_.empty()) told_.resize(ids_.size());
  static_cast<void>(pdu::encode(pdu, told_[entity]));
  peer::StateCompressor& compressor = *owned.compressor;
  Compressed answer{to, {}};
  std::size_t size = 0;
  if (to.row < near_rows) size = compressor.compress_independent(pdu, octets_);
  if (size == 0) {
    answer.to.row = near_rows;
    const bool is_event = reason == deadreckon::SendReason::event;
    const auto made = compressor.compress(pdu, to.cell, is_event, now, octets_);
    answer.is_key = made.is_key;
    answer.needs_key = made.needs_key;
    size = made.size;
  }
  answer.octets = std::span<const std::byte>(octets_).first(size);
  return answer;
}

}  // namespace reckon::bench

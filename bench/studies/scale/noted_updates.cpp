// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/noted_updates.hpp"

#include <algorithm>

#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/pdu/codec/codec.hpp"

namespace reckon::bench {

void NotedUpdates::add(const SentUpdate& update, std::span<const std::byte> state) {
  Noted& noted = noted_.emplace_back(Noted{update, {}});
  std::copy_n(state.begin(), std::min(state.size(), noted.octets.size()), noted.octets.begin());
}

void NotedUpdates::tell(Witnesses& witnesses, const deadreckon::LocalFrame& frame) {
  for (const Noted& noted : noted_) {
    pdu::EntityState pdu;
    deadreckon::KinematicState state;
    if (pdu::decode(noted.octets, pdu) != pdu::DecodeError::none ||
        from_wire(pdu, frame, state) != deadreckon::ConversionError::none)
      continue;
    witnesses.send(noted.update, state);
  }
  noted_.clear();
}

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/compression/state_restorer.hpp"

#include "reckon/pdu/compression/compact_state.hpp"

namespace reckon::peer {

using pdu::CompressedForm;

void StateRestorer::note_plain(const pdu::EntityState& state) {
  if (form_ != CompressedForm::delta && form_ != CompressedForm::residual) return;
  Known& known = known_[place_for(state.entity_id.key())];
  if (form_ == CompressedForm::residual) return known.residual.note_plain(state);
  pdu::EntityState bare = state;
  bare.header.pdu_status = 0;  // the sender's bundle may have set what an Attribute PDU wants
  bare.variable_parameters = {};
  if (pdu::encode(bare, known.octets) == 0) return;
  known.check = pdu::key_check(known.octets);
}

std::size_t StateRestorer::place_for(std::uint64_t key) {
  const auto found = places_.find(key);
  if (found != places_.end()) return found->second;
  std::size_t place = known_.size();
  if (place < capacity_) {
    known_.emplace_back();
  } else {
    place = oldest_;
    oldest_ = (oldest_ + 1) % capacity_;
    places_.erase(known_[place].key);
    known_[place] = Known();
  }
  known_[place].key = key;
  places_[key] = place;
  return place;
}

RestoreVerdict StateRestorer::restore(const pdu::CompressedStates& states,
                                      const pdu::CompressedState& state, pdu::EntityState& out) {
  if (states.layout != 1) return RestoreVerdict::malformed;
  if (state.form != CompressedForm::compact) return lean_on_key(states, state, out);
  pdu::EntityState restored;
  restored.header.exercise_id = states.header.exercise_id;
  restored.entity_id = {states.simulation.site, states.simulation.application, state.entity};
  if (!pdu::decode_compact(state.body, states.header.timestamp, {}, restored)) {
    return RestoreVerdict::malformed;
  }
  out = restored;
  note_plain(out);
  return RestoreVerdict::good;
}

RestoreVerdict StateRestorer::lean_on_key(const pdu::CompressedStates& states,
                                          const pdu::CompressedState& state,
                                          pdu::EntityState& out) noexcept {
  if (state.form != form_ || form_ == CompressedForm::none) return RestoreVerdict::malformed;
  const pdu::EntityId id{states.simulation.site, states.simulation.application, state.entity};
  const auto found = places_.find(id.key());
  if (found == places_.end()) return RestoreVerdict::awaits_key;
  Known& known = known_[found->second];
  if (form_ == CompressedForm::residual) {
    switch (known.residual.decode(state.body, states.header.timestamp, out)) {
      case deadreckon::ResidualVerdict::good:
        return RestoreVerdict::good;
      case deadreckon::ResidualVerdict::no_key:
        return RestoreVerdict::awaits_key;
      case deadreckon::ResidualVerdict::malformed:
        break;
    }
    return RestoreVerdict::malformed;
  }
  if (pdu::key_of_delta(state.body) != known.check) return RestoreVerdict::awaits_key;
  std::array<std::byte, 144> plain;
  pdu::EntityState restored;
  const bool good = pdu::decode_delta(known.octets, state.body, plain) &&
                    pdu::decode(plain, restored) == pdu::DecodeError::none &&
                    restored.entity_id == id && restored.variable_parameters.empty();
  if (good) out = restored;
  return good ? RestoreVerdict::good : RestoreVerdict::malformed;
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets as a Compressed States PDU, read by the restorer of each form, which has one entity. It
// never reads beyond them, and the restored states can be sent again.
#include <array>
#include <span>

#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/peer/compression/state_restorer.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {
namespace {

void restore(std::span<const std::byte> octets, pdu::CompressedForm form) {
  peer::StateRestorer restorer(form, 4);
  pdu::EntityState key;
  key.entity_id = {1, 1, 1};
  const peer::KeySpeaker owner{{1, 1}, 7}, stranger{{2, 2}, 8};
  restorer.note_plain(key, owner);
  pdu::CompressedStates states;
  states.simulation = {1, 1};
  states.form = form;
  states.number_of_states = 0xFFFF;
  states.states.bytes = octets;
  pdu::CompressedStateReader reader(states);
  for (pdu::CompressedState one; reader.next(one);) {
    pdu::EntityState state;
    require(one.form == pdu::CompressedForm::compact ||
                restorer.restore(states, one, stranger, state) != peer::RestoreVerdict::good,
            "a state needs_key on another's key");
    if (restorer.restore(states, one, owner, state) != peer::RestoreVerdict::good) continue;
    std::array<std::byte, 144> plain;
    require(pdu::encode(state, plain) == plain.size(), "a restored state cannot be sent");
    require(state.entity_id.site == 1 && state.entity_id.entity == one.entity,
            "a restored state is of another entity");
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  for (const auto form : {pdu::CompressedForm::compact, pdu::CompressedForm::residual}) {
    restore(input, form);
  }
}

}  // namespace reckon::fuzz

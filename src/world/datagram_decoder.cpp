// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/datagram_decoder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"

namespace reckon::peer {

using pdu::DecodeError;

DatagramDecoder::DatagramDecoder(std::uint8_t exercise, Counters& counters,
                                 pdu::CompressedForm form, std::size_t capacity)
    : exercise_(exercise),
      restorer_(form, capacity),
      pdus_(counters.make("pdus_in", "valid PDUs received")),
      malformed_(counters.make("malformed_in", "damaged PDUs, refused")),
      foreign_(counters.make("other_exercise_in", "PDUs of another exercise, dropped")),
      unknown_(counters.make("unused_in", "PDUs of unused types, skipped")),
      overflow_(counters.make("too_many_in", "updates beyond the limit of one datagram")),
      restored_(counters.make("compressed_in", "compressed Entity States received")),
      keys_awaited_(counters.make("keys_awaited",
                                  "compressed states whose key state did not arrive, dropped")),
      keys_of_others_(counters.make(
          "keys_of_others", "compressed states of entities that their sender does not own")),
      overtaken_(counters.make(
          "overtaken_in",
          "states that were replaced by a newer one of their entity before they were processed")) {}

std::span<const Inbound> DatagramDecoder::decode(std::span<const std::byte> datagram,
                                                 const pdu::SimulationAddress& own,
                                                 std::uint64_t overtaken, const KeySpeaker& speaker,
                                                 const PduFilter* filter) noexcept {
  count_ = 0;
  speaker_ = speaker;
  filter_ = filter;
  std::uint64_t good = 0, left_out = 0;
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram)) {
    if (pdu.error != DecodeError::none) {
      malformed_.add();
    } else if (pdu.header.exercise_id != exercise_) {
      foreign_.add();
    } else {
      ++good;
      const bool is_overtaken = pdu.index < 64 && (overtaken >> pdu.index & 1) != 0;
      left_out += is_overtaken ? 1 : 0;
      if (!is_overtaken && (filter == nullptr || filter->passes(pdu))) take_pdu(pdu, own);
    }
  }
  pdus_.add(good);
  if (left_out > 0) overtaken_.add(left_out);
  return {staged_.data(), count_};
}

std::span<const Inbound> DatagramDecoder::decode_held(std::span<const std::byte> octets,
                                                      const pdu::SimulationAddress& own) noexcept {
  count_ = 0;
  filter_ = nullptr;
  take_nested(octets, own);
  return {staged_.data(), count_};
}

void DatagramDecoder::leave_out(std::size_t overtaken, bool trailer) noexcept {
  pdus_.add(overtaken + (trailer ? 1 : 0));
  overtaken_.add(overtaken);
}

void DatagramDecoder::take_pdu(const pdu::BundledPdu& pdu,
                               const pdu::SimulationAddress& own) noexcept {
  switch (pdu.header.pdu_type) {
    case pdu::PduType::entity_state:
      return take_plain(pdu.bytes);
    case pdu::PduType::compressed_states:
      return take_compressed(pdu.bytes);
    case pdu::PduType::attribute:
      return take_attribute(pdu.bytes, own);
    case pdu::PduType::stop_freeze:
    case pdu::PduType::start_resume:
      return take_control(pdu);
    case pdu::PduType::assured_record:
      return take_assured(pdu, own);
    case pdu::PduType::presence:
    case pdu::PduType::cell_membership:
    case pdu::PduType::time_exchange:
    case pdu::PduType::peers_heard:
    case pdu::PduType::cell_roles:
    case pdu::PduType::group_map:
    case pdu::PduType::cell_snapshot:
    case pdu::PduType::datagram_trailer:
      return;  // handled by the area-of-interest manager and the peers' clocks
    case pdu::PduType::electromagnetic_emission:
    case pdu::PduType::iff:
    case pdu::PduType::transmitter:
      return take_other(pdu);
    default:
      take_other(pdu);
      return unknown_.add();
  }
}

void DatagramDecoder::take_other(const pdu::BundledPdu& pdu) noexcept {
  if (Inbound* update = stage(Inbound::Kind::other, {})) update->pdu = pdu;
}

// A record that holds a PDU becomes the update of this PDU, any other one an update of its own.
void DatagramDecoder::take_assured(const pdu::BundledPdu& pdu,
                                   const pdu::SimulationAddress& own) noexcept {
  pdu::AssuredRecord record;
  if (pdu::decode(pdu.bytes, record) != DecodeError::none) return malformed_.add();
  if (record.kind == pdu::AssuredKind::mark) return take_mark(record, pdu.bytes);
  const std::size_t before = count_;
  const bool holds_pdu =
      record.kind == pdu::AssuredKind::record && (record.flags & pdu::kAssuredPdu) != 0;
  if (holds_pdu) take_nested(record.content.bytes, own);
  if (count_ == before) static_cast<void>(stage(Inbound::Kind::assured, {}));
  if (count_ > before) staged_[count_ - 1].record = pdu.bytes;
}

// Takes one whole standard PDU. States, their records and our own PDUs are not read from a record.
void DatagramDecoder::take_nested(std::span<const std::byte> octets,
                                  const pdu::SimulationAddress& own) noexcept {
  for (const pdu::BundledPdu& pdu : pdu::BundleReader(octets)) {
    const bool is_whole = pdu.error == DecodeError::none && pdu.bytes.size() == octets.size();
    const bool is_usual =
        pdu::bundle_rank(pdu.header.pdu_type) == pdu::bundle_rank(pdu::PduType::stop_freeze);
    const bool is_wanted = is_whole && is_usual && pdu.header.exercise_id == exercise_ &&
                           (filter_ == nullptr || filter_->passes(pdu));
    if (is_wanted) take_pdu(pdu, own);
    return;
  }
}

// The marked PDU precedes its mark.
void DatagramDecoder::take_mark(const pdu::AssuredRecord& mark,
                                std::span<const std::byte> octets) noexcept {
  pdu::AssuredMark marked;
  if (!pdu::load_record(mark.content.bytes, marked)) return malformed_.add();
  for (Inbound& update : std::span(staged_).first(count_)) {
    const bool is_pdu = update.kind != Inbound::Kind::entity && update.kind != Inbound::Kind::claim;
    if (!is_pdu || !update.record.empty() || update.pdu.bytes.size() != marked.length) continue;
    if (pdu::assured_digest(update.pdu.bytes) != marked.digest) continue;
    update.record = octets;
    return;
  }
}

// Decodes in place, unless an update of this entity is already staged.
void DatagramDecoder::take_plain(std::span<const std::byte> bytes) noexcept {
  pdu::EntityState& state = staged_[count_].state;
  if (pdu::decode(bytes, state) != DecodeError::none) return malformed_.add();
  restorer_.note_plain(state, speaker_);
  if (count_ == kMaxUpdates || find_staged(state.entity_id) != nullptr) return take_state(state);
  add_staged(Inbound::Kind::entity, state.entity_id);
  staged_[count_ - 1].has_state = true;
}

void DatagramDecoder::take_state(const pdu::EntityState& state) noexcept {
  Inbound* update = stage(Inbound::Kind::entity, state.entity_id);
  if (update == nullptr) return;
  update->has_state = true;
  update->state = state;
}

void DatagramDecoder::take_compressed(std::span<const std::byte> bytes) noexcept {
  pdu::CompressedStates states;
  if (pdu::decode(bytes, states) != DecodeError::none) return malformed_.add();
  pdu::CompressedStateReader reader(states);
  for (pdu::CompressedState one; reader.next(one);) {
    pdu::EntityState state;
    switch (restorer_.restore(states, one, speaker_, state)) {
      case RestoreVerdict::good:
        restored_.add();
        take_state(state);
        break;
      case RestoreVerdict::awaits_key:
        keys_awaited_.add();
        break;
      case RestoreVerdict::malformed:
        malformed_.add();
        break;
      case RestoreVerdict::not_theirs:
        keys_of_others_.add();
        static_cast<void>(stage(Inbound::Kind::claim, {states.simulation.site,
                                                       states.simulation.application, one.entity}));
        break;
    }
  }
  if (reader.left() > 0) malformed_.add();
}

void DatagramDecoder::take_attribute(std::span<const std::byte> bytes,
                                     const pdu::SimulationAddress& own) noexcept {
  pdu::Attribute attribute;
  if (pdu::decode(bytes, attribute) != DecodeError::none) return malformed_.add();
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    for (const pdu::AttributeRecord& record : set.records())
      take_record(set.entity_id, record, own);
  }
}

void DatagramDecoder::take_record(const pdu::EntityId& entity, const pdu::AttributeRecord& record,
                                  const pdu::SimulationAddress& own) noexcept {
  pdu::HapticRecord model;
  pdu::EnergyAccountRecord account;
  pdu::OwnershipRecord ownership;
  if (pdu::decode(record, model) == DecodeError::none) {
    if (Inbound* update = stage(Inbound::Kind::entity, entity)) {
      update->has_model = true;
      update->model = model;
    }
  } else if (pdu::decode(record, account) == DecodeError::none) {
    take_account(entity, account, own);
  } else if (pdu::decode(record, ownership) == DecodeError::none) {
    if (Inbound* update = stage(Inbound::Kind::entity, entity)) update->ownership = ownership;
  }
}

void DatagramDecoder::take_account(const pdu::EntityId& entity,
                                   const pdu::EnergyAccountRecord& account,
                                   const pdu::SimulationAddress& own) noexcept {
  Inbound* update = stage(Inbound::Kind::entity, entity);
  if (update == nullptr) return;
  if (account.counterpart == aoim::kAllBodies) {
    if (std::isfinite(account.given)) update->body_energy = account.given;
    return;
  }
  const bool exchanges = account.given > 0.0 || account.need > 0 || account.spring_need > 0;
  if (exchanges && update->accounts_told < std::numeric_limits<std::uint8_t>::max())
    ++update->accounts_told;
  if (account.counterpart.simulation() != own) return;
  const auto end = update->accounts.begin() + static_cast<std::ptrdiff_t>(update->account_count);
  const auto known = std::find_if(update->accounts.begin(), end, [&](const auto& other) {
    return other.counterpart == account.counterpart;
  });
  if (known == update->accounts.end()) return overflow_.add();
  *known = account;
  if (known == end) ++update->account_count;
}

void DatagramDecoder::take_control(const pdu::BundledPdu& pdu) noexcept {
  const auto control = [&](Inbound::Kind kind, const auto& message) {
    if (Inbound* update = stage(kind, message.receiving_entity_id)) {
      update->pdu = pdu;
      update->originator = message.originating_entity_id;
      update->request_id = message.request_id;
    }
  };
  pdu::StopFreeze stop;
  pdu::StartResume start;
  if (pdu::decode(pdu.bytes, stop) == DecodeError::none) {
    control(Inbound::Kind::stop_freeze, stop);
  } else if (pdu::decode(pdu.bytes, start) == DecodeError::none) {
    control(Inbound::Kind::start_resume, start);
  } else {
    malformed_.add();
  }
}

Inbound* DatagramDecoder::find_staged(const pdu::EntityId& entity) noexcept {
  const auto end = entities_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::find(entities_.begin(), end, entity.key());
  return found == end ? nullptr : &staged_[static_cast<std::size_t>(found - entities_.begin())];
}

Inbound* DatagramDecoder::stage(Inbound::Kind kind, const pdu::EntityId& entity) noexcept {
  // The Attribute of a bundle extends an Entity State before it: one update for both.
  if (kind == Inbound::Kind::entity) {
    if (Inbound* known = find_staged(entity)) return known;
  }
  if (count_ == kMaxUpdates) {
    overflow_.add();
    return nullptr;
  }
  add_staged(kind, entity);
  return &staged_[count_ - 1];
}

// Requires free room. Leaves the state unchanged.
void DatagramDecoder::add_staged(Inbound::Kind kind, const pdu::EntityId& entity) noexcept {
  entities_[count_] = kind == Inbound::Kind::entity ? entity.key() : kNoEntity;
  Inbound& update = staged_[count_++];
  update.kind = kind;
  update.entity = entity;
  update.has_state = update.has_model = false;
  update.ownership.reset();
  update.account_count = 0;
  update.accounts_told = 0;
  update.body_energy = 0.0;
  update.record = {};
}

}  // namespace reckon::peer

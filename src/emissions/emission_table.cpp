// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/emissions/emission_table.hpp"

#include <algorithm>

#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

constexpr std::uint8_t kChangedData = 1;     // state update indicator, SISO-REF-010 UID 77
constexpr std::uint8_t kOnTransmitting = 2;  // transmit state, UID 164

EmittedBeam beam_of(const pdu::SizedRecord<pdu::EmitterBeam>& sent, bool has_status,
                    nanoseconds now) {
  EmittedBeam beam{.beam = sent.head, .since = now};
  if (!has_status) beam.beam.jamming.beam_status = 0;
  const std::size_t octets = beam.known_targets().size() * pdu::kFixedSize<pdu::TrackJamTarget>;
  std::size_t count = 0;
  for (const auto& target : pdu::records_of<pdu::TrackJamTarget>(sent.body.first(octets)))
    beam.targets[count++] = target;
  return beam;
}

// The beam with this number, or the end of the known ones.
EmittedBeam* find_beam(EmitterState& state, std::uint8_t number) {
  EmittedBeam* begin = state.beams.data();
  return std::find_if(begin, begin + state.count,
                      [&](const EmittedBeam& beam) { return beam.beam.beam_number == number; });
}

// @param next the new state: initially a copy of `before` for changed data, else empty
void add_beam(EmitterState& next, EmittedBeam beam, EmitterState& before) {
  const std::uint8_t number = beam.beam.beam_number;
  const EmittedBeam* known = find_beam(before, number);
  const bool is_known = known != before.beams.data() + before.count;
  if (is_known && known->is_active() == beam.is_active()) beam.since = known->since;
  EmittedBeam* place = find_beam(next, number);
  const bool is_new = place == next.beams.data() + next.count;
  if (is_new && next.count == EmitterState::kBeams) {
    ++next.left_out;
    return;
  }
  if (is_new) ++next.count;
  *place = beam;
}

bool is_same_system(const Emission& a, const Emission& b) {
  if (a.kind() != b.kind() || a.number != b.number) return false;
  const auto* left = std::get_if<pdu::Iff>(&a.state);
  const auto* right = std::get_if<pdu::Iff>(&b.state);
  return left == nullptr || left->system_type == right->system_type;
}

bool is_same_host(const aoim::SourceAddress& a, const aoim::SourceAddress& b) {
  return a.boot == b.boot && (a.boot != 0 || a.octets == b.octets);
}

void add_to_view(const EmitterState& state, EmittedView& view) {
  ++view.emitters;
  for (const EmittedBeam& beam : state.known_beams()) {
    if (!beam.is_active()) continue;
    const bool first = view.beams++ == 0;
    view.targets = static_cast<std::uint16_t>(view.targets + beam.known_targets().size());
    if (!first && !(beam.beam.effective_radiated_power > view.beam_dbm)) continue;
    view.beam_dbm = beam.beam.effective_radiated_power;
    view.beam_hz = beam.beam.frequency;
  }
}

}  // namespace

bool Emission::emits() const noexcept {
  if (const auto* emitter = std::get_if<EmitterState>(&state))
    return std::ranges::any_of(emitter->known_beams(), &EmittedBeam::is_active);
  if (const auto* iff = std::get_if<pdu::Iff>(&state)) return (iff->system_status & 1U) != 0;
  return std::get_if<pdu::Transmitter>(&state)->transmit_state == kOnTransmitting;
}

nanoseconds Emission::lifetime() const noexcept {
  const nanoseconds heartbeat = kind() == Kind::emitter ? kEmitterHeartbeat
                                : kind() == Kind::iff   ? kIffHeartbeat
                                                        : kRadioHeartbeat;
  return pdu::from_seconds(deadreckon::kTimeoutMultiplier * pdu::to_seconds(heartbeat));
}

EmissionTable::EmissionTable(std::size_t rows) : rows_(rows), entities_(rows), owners_(rows) {}

bool EmissionTable::read(std::span<const std::byte> octets, auto& pdu) noexcept {
  const bool good = pdu::decode(octets, pdu) == pdu::DecodeError::none;
  if (!good) ++refusals_.damaged;
  return good;
}

void EmissionTable::take(std::span<const std::byte> octets, const EmissionSource& source) noexcept {
  pdu::PduHeader header;
  if (pdu::decode_header(octets, header) != pdu::DecodeError::none) return;
  pdu::ElectromagneticEmission emission;
  pdu::Iff iff;
  pdu::Transmitter radio;
  if (header.pdu_type == pdu::PduType::electromagnetic_emission && read(octets, emission))
    take_emitters(emission, source);
  if (header.pdu_type == pdu::PduType::iff && read(octets, iff)) {
    iff.layers = {};
    take_whole({.entity = iff.emitting_entity_id, .number = iff.system_designator, .state = iff},
               source);
  }
  if (header.pdu_type == pdu::PduType::transmitter && read(octets, radio)) {
    radio.variable_transmitter_parameters = {};
    radio.antenna_pattern = {};
    radio.modulation_parameters = {};
    take_whole({.entity = radio.radio_reference_id, .number = radio.radio_number, .state = radio},
               source);
  }
}

void EmissionTable::take_emitters(const pdu::ElectromagneticEmission& pdu,
                                  const EmissionSource& source) noexcept {
  drop_of_others(pdu.emitting_entity_id, source);
  // Systems of DIS 5 and 6 have the same layout; only field names differ.
  const bool dis6 = pdu::is_before_dis7(pdu.header);
  pdu::SizedRecords<pdu::EmitterSystem, std::uint8_t> systems = pdu.systems;
  if (dis6) systems = {pdu.dis6_systems.count, pdu.dis6_systems.bytes};
  std::size_t seen = 0;
  for (const auto& [head, body] : systems.records()) {
    if (++seen > kRowsOfEntity) {
      ++refusals_.no_room;
      continue;
    }
    Emission* row = find_or_add({.entity = pdu.emitting_entity_id, .number = head.number}, source);
    if (row == nullptr) continue;
    EmitterState& before = *std::get_if<EmitterState>(&row->state);
    const bool changes = pdu.state_update_indicator == kChangedData && head.number_of_beams > 0;
    EmitterState next = changes ? before : EmitterState();
    next.system = head;
    next.left_out = 0;
    using Beams = pdu::SizedRecords<pdu::EmitterBeam, std::uint8_t>;
    for (const auto& beam : Beams{head.number_of_beams, body}.records())
      add_beam(next, beam_of(beam, !dis6, source.now), before);
    update(*row, next, source.now);
  }
}

void EmissionTable::take_whole(const Emission& sent, const EmissionSource& source) noexcept {
  drop_of_others(sent.entity, source);
  if (Emission* row = find_or_add(sent, source)) update(*row, sent.state, source.now);
}

// Returns the row only to the host that made it; a row that has timed out is replaced.
Emission* EmissionTable::find_or_add(const Emission& wanted,
                                     const EmissionSource& source) noexcept {
  std::size_t of_entity = 0;
  for (std::size_t place = 0; place < rows_.size(); ++place) {
    if (entities_[place] != wanted.entity.key()) continue;
    ++of_entity;
    if (!is_same_system(rows_[place], wanted)) continue;
    if (rows_[place].is_over(source.now)) {
      erase(place);
      return add(wanted, source);
    }
    if (is_same_host(owners_.owner(place), source.from)) return &rows_[place];
    ++refusals_.disputed;
    return nullptr;
  }
  if (of_entity < kRowsOfEntity) return add(wanted, source);
  ++refusals_.no_room;
  return nullptr;
}

Emission* EmissionTable::add(const Emission& wanted, const EmissionSource& source) noexcept {
  if (!make_room(source) || !owners_.push(source.from, source.guest, source.now)) {
    ++refusals_.no_room;
    return nullptr;
  }
  entities_.push(wanted.entity.key());
  Emission& row = rows_.push(wanted);
  row.since = row.last_heard = source.now;
  return &row;
}

bool EmissionTable::make_room(const EmissionSource& source) noexcept {
  if (rows_.size() == rows_.capacity()) expire(source.now);
  if (rows_.size() < rows_.capacity()) return true;
  const auto place = source.guest ? owners_.guest_to_give_up(source.from)
                                  : owners_.row_to_give_up(source.from, false);
  if (place) erase(*place);
  return place.has_value();
}

void EmissionTable::update(Emission& row, const auto& state, nanoseconds now) noexcept {
  const bool emitted = row.emits();
  row.state = state;
  if (row.updates > 0 && row.emits() != emitted) row.since = now;
  row.last_heard = std::max(row.last_heard, now);
  ++row.updates;
  next_over_ = std::min(next_over_, row.last_heard + row.lifetime());
}

void EmissionTable::expire(nanoseconds now) noexcept {
  if (now <= next_over_) return;
  next_over_ = nanoseconds::max();
  for (std::size_t place = rows_.size(); place-- > 0;) {
    const Emission& row = rows_[place];
    if (row.is_over(now))
      erase(place);
    else
      next_over_ = std::min(next_over_, row.last_heard + row.lifetime());
  }
}

void EmissionTable::drop(const pdu::SimulationAddress& simulation) noexcept {
  for (std::size_t place = rows_.size(); place-- > 0;)
    if (rows_[place].entity.simulation() == simulation) erase(place);
}

// Once the owner of the entity is known, rows from other hosts are dropped.
void EmissionTable::drop_of_others(const pdu::EntityId& entity,
                                   const EmissionSource& source) noexcept {
  if (!source.owns) return;
  for (std::size_t place = rows_.size(); place-- > 0;) {
    const bool is_others =
        entities_[place] == entity.key() && !is_same_host(owners_.owner(place), source.from);
    if (is_others) erase(place);
  }
}

void EmissionTable::erase(std::size_t place) noexcept {
  rows_.erase(place);
  entities_.erase(place);
  owners_.erase(place);
}

void EmissionTable::summarise(std::span<EntityView> entities) const noexcept {
  for (EntityView& entity : entities) entity.emits = {};
  for (const Emission& row : rows_.all()) {
    const auto found = std::ranges::lower_bound(entities, row.entity, {}, &EntityView::id);
    if (found == entities.end() || found->id != row.entity) continue;
    EmittedView& view = found->emits;
    if (const auto* emitter = std::get_if<EmitterState>(&row.state)) {
      add_to_view(*emitter, view);
    } else if (const auto* iff = std::get_if<pdu::Iff>(&row.state)) {
      ++view.iff;
      if (!row.emits() || view.iff_on++ > 0) continue;
      view.iff_type = iff->system_type;
      view.mode_3a = iff->parameter_3;
    } else if (const auto* radio = std::get_if<pdu::Transmitter>(&row.state)) {
      ++view.radios;
      if (row.emits() && view.transmitting++ == 0)
        view.radio_hz = static_cast<double>(radio->frequency);
    }
  }
}

}  // namespace reckon::peer

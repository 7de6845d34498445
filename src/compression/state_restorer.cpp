// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/compression/state_restorer.hpp"

#include <algorithm>

#include "reckon/pdu/compression/compact_state.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kNone = ~std::size_t{0};
constexpr std::size_t kFewKeys = 64;  // up to this number no memory is given back

template <typename T>
void move_last_to(std::vector<T>& rows, std::size_t place) {
  rows[place] = rows.back();
  rows.pop_back();
}

template <typename T>
void give_back_memory(std::vector<T>& rows) {
  if (rows.capacity() > kFewKeys && rows.size() < rows.capacity() / 4) rows.shrink_to_fit();
}

}  // namespace

using pdu::CompressedForm;

void StateRestorer::note_plain(const pdu::EntityState& state, const KeySpeaker& speaker) {
  if (!needs_key() || !speaker.owns(state.entity_id.simulation())) return;
  residuals_[place_for(state.entity_id.key(), speaker)].note_plain(state);
}

// Place of the entity in this epoch of its owner, without data of a former one.
std::size_t StateRestorer::place_for(std::uint64_t key, const KeySpeaker& speaker) {
  const auto found = places_.find(key);
  if (found == places_.end()) {
    if (known_.size() >= capacity_) make_room();
    add(key, speaker);
    return known_.size() - 1;
  }
  Known& known = known_[found->second];
  if (known.epoch != speaker.epoch) {
    erase(found->second);
    add(key, speaker);
    return known_.size() - 1;
  }
  known.from = speaker.from;
  return found->second;
}

void StateRestorer::add(std::uint64_t key, const KeySpeaker& speaker) {
  places_[key] = known_.size();
  known_.push_back({key, speaker.epoch, speaker.from, speaker.from});
  residuals_.emplace_back();
  ++counts_[speaker.from.octets];
}

// Removes an entity of the host that has the most.
void StateRestorer::make_room() {
  const auto crowded = std::max_element(
      counts_.begin(), counts_.end(),
      [](const auto& one, const auto& other) { return one.second < other.second; });
  cursor_ %= known_.size();
  while (known_[cursor_].home.octets != crowded->first) cursor_ = (cursor_ + 1) % known_.size();
  erase(cursor_++);  // the last one has taken its place
}

void StateRestorer::erase(std::size_t place) {
  const auto count = counts_.find(known_[place].home.octets);
  if (--count->second == 0) counts_.erase(count);
  places_.erase(known_[place].key);
  if (place + 1 < known_.size()) places_[known_.back().key] = place;
  move_last_to(known_, place);
  move_last_to(residuals_, place);
}

void StateRestorer::forget(std::uint32_t epoch) {
  for (std::size_t place = known_.size(); place > 0; --place) {
    if (known_[place - 1].epoch == epoch) erase(place - 1);
  }
  give_back_memory(known_);
  give_back_memory(residuals_);
}

RestoreVerdict StateRestorer::restore(const pdu::CompressedStates& states,
                                      const pdu::CompressedState& state, const KeySpeaker& speaker,
                                      pdu::EntityState& out) {
  if (states.layout != 1) return RestoreVerdict::malformed;
  if (state.form != CompressedForm::compact) return lean_on_key(states, state, speaker, out);
  pdu::EntityState restored;
  restored.header.exercise_id = states.header.exercise_id;
  restored.entity_id = {states.simulation.site, states.simulation.application, state.entity};
  if (!pdu::decode_compact(state.body, states.header.timestamp, {}, restored)) {
    return RestoreVerdict::malformed;
  }
  out = restored;
  note_plain(out, speaker);
  return RestoreVerdict::good;
}

// The place of key states on which this sender's states may depend.
std::size_t StateRestorer::find(const pdu::EntityId& id, const KeySpeaker& speaker) const noexcept {
  const auto found = places_.find(id.key());
  if (found == places_.end()) return kNone;
  const Known& known = known_[found->second];
  const bool moved_on = known.from != speaker.from && known.home != speaker.from;
  const bool same = known.epoch == speaker.epoch && (known.from == speaker.from || moved_on);
  return same ? found->second : kNone;
}

RestoreVerdict StateRestorer::lean_on_key(const pdu::CompressedStates& states,
                                          const pdu::CompressedState& state,
                                          const KeySpeaker& speaker,
                                          pdu::EntityState& out) noexcept {
  if (state.form != form_ || !needs_key()) return RestoreVerdict::malformed;
  if (!speaker.owns(states.simulation)) return RestoreVerdict::not_theirs;
  const pdu::EntityId id{states.simulation.site, states.simulation.application, state.entity};
  const std::size_t place = find(id, speaker);
  if (place == kNone) return RestoreVerdict::awaits_key;
  switch (residuals_[place].decode(state.body, states.header.timestamp, out)) {
    case deadreckon::ResidualVerdict::good:
      return RestoreVerdict::good;
    case deadreckon::ResidualVerdict::no_key:
      return RestoreVerdict::awaits_key;
    case deadreckon::ResidualVerdict::malformed:
      break;
  }
  return RestoreVerdict::malformed;
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Restores Entity States from compressed ones, before any other stage reads them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/deadreckon/residual/residual_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::peer {

/// Sender of a datagram's content. Only a state of an epoch's own entity is a key state, and only
/// states of the same epoch may depend on it.
struct KeySpeaker {
  pdu::SimulationAddress simulation;  ///< whose entities are its own
  std::uint32_t epoch = 0;            ///< 0: it is no peer, and has no key states
  aoim::SourceAddress from = {};      ///< source address of the datagram

  [[nodiscard]] bool owns(const pdu::SimulationAddress& entities) const noexcept {
    return epoch != 0 && entities == simulation;
  }
};

/// Result for one compressed state.
enum class RestoreVerdict : std::uint8_t {
  good,
  awaits_key,  ///< it depends on a lost key state: the entity's next one helps
  malformed,   ///< its octets are no body of their form, or of another form than the scene's
  not_theirs,  ///< it depends on key states of an entity that its sender does not own
};

/// All entities of others. One thread, never throws. Allocates for a new entity, 0.6 KiB each in
/// scenes of the residual form, up to `capacity` of them. If it is full, an entity of the host
/// (address) with the most is removed and awaits a key state, so that a host that invents entities
/// cannot displace entities of another host.
///
/// Key states are kept by entity, epoch and address, so a state from any other sender is never a
/// key state, regardless of its octets. An epoch that continues from another address keeps its key
/// states. If it returns to a former address, it needs new ones, because another sender may have
/// sent in between.
class StateRestorer {
 public:
  /// @param form of the scene; compact ones are accepted in any scene.  @param capacity at least 1
  StateRestorer(pdu::CompressedForm form, std::size_t capacity)
      : form_(form), capacity_(capacity > 0 ? capacity : 1) {}

  /// Takes a plain Entity State, which is a key state if its sender owns the entity.
  void note_plain(const pdu::EntityState& state, const KeySpeaker& speaker);

  /// Restores one state of `states` into `out`, which is changed only if the verdict is good.
  [[nodiscard]] RestoreVerdict restore(const pdu::CompressedStates& states,
                                       const pdu::CompressedState& state, const KeySpeaker& speaker,
                                       pdu::EntityState& out);
  /// Forgets the key states of an ended epoch, and gives their memory back once most are gone.
  /// Visits all.
  void forget(std::uint32_t epoch);

  /// Entities with known key states.
  [[nodiscard]] std::size_t size() const noexcept { return known_.size(); }

 private:
  using Host = std::array<std::uint8_t, 16>;
  struct Known {
    std::uint64_t key = 0;  // of the entity
    std::uint32_t epoch = 0;
    aoim::SourceAddress home, from;  // of the first key state in this epoch, and of the last
  };
  [[nodiscard]] std::size_t place_for(std::uint64_t key, const KeySpeaker& speaker);
  [[nodiscard]] std::size_t find(const pdu::EntityId& id, const KeySpeaker& speaker) const noexcept;
  [[nodiscard]] RestoreVerdict lean_on_key(const pdu::CompressedStates& states,
                                           const pdu::CompressedState& state,
                                           const KeySpeaker& speaker,
                                           pdu::EntityState& out) noexcept;
  void add(std::uint64_t key, const KeySpeaker& speaker);
  void make_room();
  void erase(std::size_t place);
  [[nodiscard]] bool needs_key() const noexcept { return form_ == pdu::CompressedForm::residual; }

  pdu::CompressedForm form_;
  std::size_t capacity_;
  std::unordered_map<std::uint64_t, std::size_t> places_;  // by the entity's key
  std::vector<Known> known_;
  std::vector<deadreckon::ResidualDecoder> residuals_;  // parallel to it
  std::map<Host, std::size_t> counts_;                  // of known_, by the host of `home`
  std::size_t cursor_ = 0;  // in known_: start of the search for the next to remove
};

}  // namespace reckon::peer

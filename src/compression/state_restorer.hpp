// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes Entity States of compressed ones, before anything else looks at them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/deadreckon/residual/residual_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::peer {

/// Who says what is in a datagram. Only what a life has said of its own entities is a key, and only
/// of what it says itself.
struct KeySpeaker {
  pdu::SimulationAddress simulation;  ///< whose entities are its own
  std::uint32_t epoch = 0;            ///< of its life; 0: it is no peer, and has no keys
  aoim::SourceAddress from = {};      ///< where the datagram came from

  [[nodiscard]] bool owns(const pdu::SimulationAddress& entities) const noexcept {
    return epoch != 0 && entities == simulation;
  }
};

/// What became of one compressed state.
enum class RestoreVerdict : std::uint8_t {
  good,
  awaits_key,  ///< it leans on a key that did not arrive: the entity's next key helps
  malformed,   ///< its octets are no body of their form, or of another form than the scene's
  not_theirs,  ///< it leans on keys of an entity that is not its speaker's
};

/// All entities of others. One thread, never throws; allocates where a new entity comes, 0.6 KiB
/// each in scenes of the residual form, up to `capacity` of them: then one of the host (address)
/// with the most is forgotten and awaits a key, so that a host that invents entities displaces none
/// of another.
///
/// Keys are kept by entity, life and address: what anybody else says of the entity is none, however
/// its octets were chosen. A life that goes on from another address takes its keys along; one that
/// comes back to where it was before needs new ones, for in between somebody else may have spoken.
class StateRestorer {
 public:
  /// @param form of the scene; compact ones are read whatever it is. @param capacity at least 1
  StateRestorer(pdu::CompressedForm form, std::size_t capacity)
      : form_(form), capacity_(capacity > 0 ? capacity : 1) {}

  /// A plain Entity State came: a key, where it is of an entity of the speaker's.
  void note_plain(const pdu::EntityState& state, const KeySpeaker& speaker);

  /// Restores one state of `states` into `out`, which is touched only where the verdict is good.
  [[nodiscard]] RestoreVerdict restore(const pdu::CompressedStates& states,
                                       const pdu::CompressedState& state, const KeySpeaker& speaker,
                                       pdu::EntityState& out);
  /// A life is over: its keys are forgotten, and their memory is given back once most are. Looks at
  /// all.
  void forget(std::uint32_t epoch);

  /// Entities whose keys are known.
  [[nodiscard]] std::size_t size() const noexcept { return known_.size(); }

 private:
  using Host = std::array<std::uint8_t, 16>;
  struct Known {
    std::uint64_t key = 0;  // of the entity
    std::uint32_t epoch = 0;
    aoim::SourceAddress home, from;  // of the first key in this life, and of the last
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
  [[nodiscard]] bool leans() const noexcept { return form_ == pdu::CompressedForm::residual; }

  pdu::CompressedForm form_;
  std::size_t capacity_;
  std::unordered_map<std::uint64_t, std::size_t> places_;  // by the entity's key
  std::vector<Known> known_;
  std::vector<deadreckon::ResidualDecoder> residuals_;     // beside it
  std::map<Host, std::size_t> counts_;  // of known_, by the host of `home`
  std::size_t cursor_ = 0;              // in known_: where the next to be forgotten is looked for
};

}  // namespace reckon::peer

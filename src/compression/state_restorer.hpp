// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Makes Entity States of compressed ones, before anything else looks at them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "reckon/deadreckon/residual/residual_state.hpp"
#include "reckon/pdu/compression/delta_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"

namespace reckon::peer {

/// What became of one compressed state.
enum class RestoreVerdict : std::uint8_t {
  good,
  awaits_key,  ///< it leans on a key that did not arrive: the entity's next key helps
  malformed,   ///< its octets are no body of their form, or of another form than the scene's
};

/// All entities of others. One thread, never throws; allocates where a new entity comes, 1 KiB
/// each, up to `capacity` of them: then the one that came first is forgotten and awaits a key.
class StateRestorer {
 public:
  /// @param form of the scene; compact ones are read whatever it is
  StateRestorer(pdu::CompressedForm form, std::size_t capacity)
      : form_(form), capacity_(capacity) {}

  /// A plain Entity State came.
  void note_plain(const pdu::EntityState& state);

  /// Restores one state of `states` into `out`, which is touched only where the verdict is good.
  [[nodiscard]] RestoreVerdict restore(const pdu::CompressedStates& states,
                                       const pdu::CompressedState& state, pdu::EntityState& out);

 private:
  struct Known {
    std::uint64_t key = 0;
    deadreckon::ResidualDecoder residual;
    std::array<std::byte, 144> octets{};  // the key of the delta form
    std::uint16_t check = 0;
  };
  [[nodiscard]] std::size_t place_for(std::uint64_t key);
  [[nodiscard]] RestoreVerdict lean_on_key(const pdu::CompressedStates& states,
                                           const pdu::CompressedState& state,
                                           pdu::EntityState& out) noexcept;

  pdu::CompressedForm form_;
  std::size_t capacity_;
  std::unordered_map<std::uint64_t, std::size_t> places_;  // by the entity's key
  std::vector<Known> known_;
  std::size_t oldest_ = 0;  // the next to be forgotten, once there is no room
};

}  // namespace reckon::peer

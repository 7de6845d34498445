// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The key states for the Compressed States of a stream, for tools that do not take part in an
// exercise.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/compressed_states.hpp"
#include "reckon/peer/compression/state_restorer.hpp"

namespace reckon::tools {

/// Restores Entity States from compressed ones. The residual form needs a key state of the entity
/// that arrives after the first compressed state. One thread. Allocates for a new entity, 1 KiB;
/// above the maximum the oldest entities lose their keys and need new ones.
class StateKeys {
 public:
  static constexpr std::size_t kMost = 4096;

  explicit StateKeys(std::size_t most_entities = kMost) : most_(std::min(most_entities, kMost)) {}

  /// Takes a plain Entity State.
  void note_plain(const pdu::EntityState& state) {
    if (restorer_) restorer_->note_plain(state, owner_of(state.entity_id.simulation()));
  }
  /// Restores one state of `states` into `out`, which is changed only if the verdict is good.
  [[nodiscard]] peer::RestoreVerdict restore(const pdu::CompressedStates& states,
                                             const pdu::CompressedState& state,
                                             pdu::EntityState& out) {
    using pdu::CompressedForm;
    const bool is_other = states.form != CompressedForm::compact && states.form != form_;
    if (!restorer_ || is_other) {
      form_ = states.form == CompressedForm::compact ? form_ : states.form;
      restorer_.emplace(form_, most_);
    }
    return restorer_->restore(states, state, owner_of(states.simulation), out);
  }

 private:
  // A tool does not verify the sender of an entity: every state counts as sent by the owner.
  [[nodiscard]] static peer::KeySpeaker owner_of(const pdu::SimulationAddress& entities) noexcept {
    return {entities, 1};
  }

  std::size_t most_;
  std::optional<peer::StateRestorer> restorer_;           // from the first compressed state on
  pdu::CompressedForm form_ = pdu::CompressedForm::none;  // form that restorer_ reads
};

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/state_keys.hpp"

namespace reckon::tools {

peer::RestoreVerdict StateKeys::restore(const pdu::CompressedStates& states,
                                        const pdu::CompressedState& state, pdu::EntityState& out) {
  using pdu::CompressedForm;
  const bool is_other = states.form != CompressedForm::compact && states.form != form_;
  if (!restorer_ || is_other) {
    form_ = states.form == CompressedForm::compact ? form_ : states.form;
    restorer_.emplace(form_, most_);
  }
  return restorer_->restore(states, state, owner_of(states.simulation), out);
}

}  // namespace reckon::tools

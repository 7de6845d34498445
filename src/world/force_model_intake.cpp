// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/force_model_intake.hpp"

#include <algorithm>

#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/haptics/passivity/contact_potential.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

bool ForceModelIntake::take(RemoteEntity& row, std::size_t place,
                            const pdu::HapticRecord& record) noexcept {
  deadreckon::ForceModel model;
  row.model_refused = deadreckon::from_wire(record, model) != deadreckon::ConversionError::none ||
                      !haptics::is_usable(haptics::parameters(model, {}, settings_.probe_radius));
  if (row.model_refused) {
    last_refused_ = row.id;
    counts_.refused_models.add();
    return false;
  }
  if (!may_touch(row, place)) return false;
  model.validity = std::min(model.validity, settings_.longest_validity);
  row.model = model;
  row.haptic = true;
  row.party = owners_.party(place);
  // Its owner may be silent for the validity of the force model.
  row.timeout = std::max(deadreckon::timeout(deadreckon::kHapticHeartbeat), model.validity);
  row.valid_until = row.last_heard + pdu::from_seconds(model.validity);
  return true;
}

// The rule of ownership ensures that a row with an epoch belongs to the peer of its number.
bool ForceModelIntake::may_touch(const RemoteEntity& row, std::size_t place) noexcept {
  if (touch_.admits(row.id.simulation(), row.epoch != 0, owners_.owner(place))) return true;
  refuse(row, place);
  return false;
}

void ForceModelIntake::refuse(const RemoteEntity& row, std::size_t place) noexcept {
  last_untouchable_ = {row.id, owners_.owner(place)};
  counts_.untouchables.add();
}

}  // namespace reckon::peer

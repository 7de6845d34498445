// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Selects the accepted force models of remote entities: by their values, and by the touch rule.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/haptics/passivity/contact_potential.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/remote_counters.hpp"
#include "reckon/peer/world/remote_settings.hpp"
#include "reckon/peer/world/row_owners.hpp"
#include "reckon/peer/world/state_table.hpp"
#include "reckon/peer/world/touch_gate.hpp"

namespace reckon::peer {

/// An entity with a force model that may not touch.
struct Untouchable {
  pdu::EntityId id;
  aoim::SourceAddress from;
};

/// One thread; no allocation.
class ForceModelIntake {
 public:
  /// References outlive this.
  ForceModelIntake(const RemoteSettings& settings, const RowOwners& owners, TouchGate& touch,
                   const RemoteCounters& counts)
      : settings_(settings), owners_(owners), touch_(touch), counts_(counts) {}

  /// Gives the row at `place` the model of its last update. Returns false if the model is refused,
  /// which is counted; the row then keeps the old one.
  bool take(RemoteEntity& row, std::size_t place, const pdu::HapticRecord& record) noexcept {
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

  /// Entity of the last model refused for its values.
  [[nodiscard]] const pdu::EntityId& last_refused() const noexcept { return last_refused_; }
  /// Number of models from entities that may not touch, and the last such entity.
  [[nodiscard]] std::uint64_t untouchable() const noexcept { return counts_.untouchables.value(); }
  [[nodiscard]] const Untouchable& last_untouchable() const noexcept { return last_untouchable_; }
  /// Counts a body of `row` that is not felt by the touch rule.
  void refuse(const RemoteEntity& row, std::size_t place) noexcept {
    last_untouchable_ = {row.id, owners_.owner(place)};
    counts_.untouchables.add();
  }

 private:
  [[nodiscard]] bool may_touch(const RemoteEntity& row, std::size_t place) noexcept {
    // The rule of ownership ensures that a row with an epoch belongs to the peer of its number.
    if (touch_.admits(row.id.simulation(), row.epoch != 0, owners_.owner(place))) return true;
    refuse(row, place);
    return false;
  }

  const RemoteSettings& settings_;
  const RowOwners& owners_;
  TouchGate& touch_;
  const RemoteCounters& counts_;
  pdu::EntityId last_refused_;
  Untouchable last_untouchable_;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/row_admission.hpp"

#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/world/held_states.hpp"

namespace reckon::peer {
namespace {

// Size of one shown entity, in all tables that have a row for it.
std::size_t row_octets(const RemoteSettings& settings) {
  constexpr std::size_t kBeside = 320;  // owner, instants, index, near search, list of changes
  std::size_t octets = sizeof(RemoteEntity) + sizeof(SenderClock) + kBeside;
  if (settings.is_adaptive()) octets += sizeof(deadreckon::AdaptiveOrder);
  if (settings.record_changes) octets += sizeof(RemoteCopy);  // of the program
  return octets + settings.near_rows * sizeof(HeldState);
}

}  // namespace

RowAdmission::RowAdmission(const RemoteSettings& settings, const StateTable& table,
                           RowOwners& owners, OutsideEntities& outside,
                           const RemoteCounters& counts)
    : settings_(settings),
      table_(table),
      owners_(owners),
      outside_(outside),
      counts_(counts),
      row_octets_(row_octets(settings)) {}

}  // namespace reckon::peer

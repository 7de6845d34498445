// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/touch_gate.hpp"

namespace reckon::peer {

bool TouchGate::admits(const aoim::PeerId& owner, bool alive,
                       const aoim::SourceAddress& from) noexcept {
  const auto place = rule_.place_of(owner);
  if (!place) return rule_.allows(owner, alive);
  std::optional<Host>& user = users_[*place];
  if (alive || !user) user = from.octets;
  return *user == from.octets;
}

}  // namespace reckon::peer

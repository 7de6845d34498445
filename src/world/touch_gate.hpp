// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Applies the touch rule of a scene to senders.
#pragma once

#include <optional>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/peer/settings/touch_rule.hpp"

namespace reckon::peer {

/// Decides which senders' bodies are felt. A listed number belongs to the peer that announces it.
/// Without such a peer it belongs to the plain DIS program at the address (any port) that used the
/// number first. One thread; allocates only at construction; some ns.
class TouchGate {
 public:
  explicit TouchGate(const TouchRule& rule) : rule_(rule), users_(rule.named_count()) {}

  /// Whether this sender's bodies are felt.
  /// @param alive whether it is the peer that announced itself with the number of `owner`
  [[nodiscard]] bool admits(const aoim::PeerId& owner, bool alive,
                            const aoim::SourceAddress& from) noexcept {
    const auto place = rule_.place_of(owner);
    if (!place) return rule_.allows(owner, alive);
    std::optional<Host>& user = users_[*place];
    if (alive || !user) user = from.octets;
    return *user == from.octets;
  }
  /// Whether the rule lists this number.
  [[nodiscard]] bool names(const aoim::PeerId& owner) const noexcept {
    return rule_.place_of(owner).has_value();
  }
  /// Whether the rule admits more than listed numbers and holders of the key.
  [[nodiscard]] bool is_open() const noexcept {
    return rule_.named_count() == 0 && !rule_.wants_key();
  }

 private:
  using Host = decltype(aoim::SourceAddress::octets);

  TouchRule rule_;
  std::vector<std::optional<Host>> users_;  // of the listed numbers
};

}  // namespace reckon::peer

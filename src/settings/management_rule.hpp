// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The senders whose orders to stop and resume (Stop/Freeze, Start/Resume) a peer obeys.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/peer/notation/simulation_names.hpp"

namespace reckon::peer {

/// The `allow_management` of a scene. A value.
class ManagementRule {
 public:
  /// Nobody.
  ManagementRule() = default;
  /// "nobody", "members" (the other peers of the scene), "anyone", or the numbers of permitted
  /// peers or plain DIS programs, "1:2" or "1:2, 40:1". Nothing for any other text.
  [[nodiscard]] static std::optional<ManagementRule> parse(std::string_view text) {
    ManagementRule rule;
    if (text == "nobody") return rule;
    rule.who_ = text == "members" ? Who::members : text == "anyone" ? Who::anyone : Who::named;
    if (rule.who_ != Who::named) return rule;
    const auto names = parse_simulations(text);
    if (!names) return {};
    rule.named_ = *names;
    return rule;
  }
  /// The text that parse() reads.
  [[nodiscard]] std::string text() const {
    if (who_ == Who::nobody) return "nobody";
    if (who_ == Who::members) return "members";
    if (who_ == Who::anyone) return "anyone";
    return simulations_text(named_);
  }

  /// @param originator of the order.
  /// @param member whether it is a peer of the scene that sends in its own name
  [[nodiscard]] bool allows(const aoim::PeerId& originator, bool member) const noexcept {
    if (who_ == Who::named) return std::ranges::find(named_, originator) != named_.end();
    return who_ == Who::anyone || (who_ == Who::members && member);
  }

 private:
  enum class Who { nobody, members, anyone, named };
  Who who_ = Who::nobody;
  std::vector<aoim::PeerId> named_;
};

}  // namespace reckon::peer

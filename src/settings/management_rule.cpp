// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/management_rule.hpp"

#include <algorithm>

#include "reckon/peer/notation/simulation_names.hpp"

namespace reckon::peer {

std::optional<ManagementRule> ManagementRule::parse(std::string_view text) {
  ManagementRule rule;
  if (text == "nobody") return rule;
  rule.who_ = text == "members" ? Who::members : text == "anyone" ? Who::anyone : Who::named;
  if (rule.who_ != Who::named) return rule;
  const auto names = parse_simulations(text);
  if (!names) return {};
  rule.named_ = *names;
  return rule;
}

std::string ManagementRule::text() const {
  if (who_ == Who::nobody) return "nobody";
  if (who_ == Who::members) return "members";
  if (who_ == Who::anyone) return "anyone";
  return simulations_text(named_);
}

bool ManagementRule::allows(const aoim::PeerId& originator, bool member) const noexcept {
  if (who_ == Who::named) return std::ranges::find(named_, originator) != named_.end();
  return who_ == Who::anyone || (who_ == Who::members && member);
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/touch_rule.hpp"

#include <algorithm>

#include "reckon/peer/scene/simulation_names.hpp"

namespace reckon::peer {

std::optional<TouchRule> TouchRule::parse(std::string_view text) {
  TouchRule rule;
  if (text == "all") return rule;
  rule.who_ = text == "members" ? Who::members : Who::named;
  if (rule.who_ == Who::members) return rule;
  const auto names = parse_simulations(text);
  if (!names) return {};
  rule.named_ = *names;
  return rule;
}

std::string TouchRule::text() const {
  if (who_ == Who::named) return simulations_text(named_);
  return who_ == Who::members ? "members" : "all";
}

bool TouchRule::allows(const aoim::PeerId& owner, bool alive) const noexcept {
  if (who_ == Who::named) return alive && std::ranges::find(named_, owner) != named_.end();
  return who_ == Who::all || alive;
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/touch_rule.hpp"

#include <algorithm>

#include "reckon/peer/notation/simulation_names.hpp"

namespace reckon::peer {

TouchRule TouchRule::usual(bool interop) {
  TouchRule rule;
  if (!interop) rule.who_ = Who::scene;
  return rule;
}

std::optional<TouchRule> TouchRule::parse(std::string_view text) {
  TouchRule rule;
  if (text == "all") return rule;
  rule.who_ = text == "scene" ? Who::scene : text == "members" ? Who::members : Who::named;
  if (rule.who_ != Who::named) return rule;
  const auto names = parse_simulations(text);
  if (!names) return {};
  rule.named_ = *names;
  return rule;
}

std::string TouchRule::text() const {
  if (who_ == Who::named) return simulations_text(named_);
  return who_ == Who::members ? "members" : who_ == Who::scene ? "scene" : "all";
}

std::optional<std::size_t> TouchRule::place_of(const aoim::PeerId& owner) const noexcept {
  const auto found = std::ranges::find(named_, owner);
  if (found == named_.end()) return {};
  return static_cast<std::size_t>(found - named_.begin());
}

bool TouchRule::allows(const aoim::PeerId& owner, bool alive) const noexcept {
  if (who_ == Who::named) return alive && place_of(owner);
  return who_ == Who::all || alive;
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owners whose bodies our hands and bodies feel.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/peer/notation/simulation_names.hpp"

namespace reckon::peer {

/// The `touch` of a scene. A value.
class TouchRule {
 public:
  /// All owners.
  TouchRule() = default;
  /// The rule of a scene without `touch`: "scene", or "all" with `interop`, where peers do not
  /// announce themselves.
  [[nodiscard]] static TouchRule usual(bool interop) {
    TouchRule rule;
    if (!interop) rule.who_ = Who::scene;
    return rule;
  }
  /// "all", "scene" (peers that announced this scene), "members" (the same with the key of the
  /// exercise), or the numbers of permitted simulations, "1:2" or "1:2, 40:1". Nothing for any
  /// other text.
  [[nodiscard]] static std::optional<TouchRule> parse(std::string_view text) {
    TouchRule rule;
    if (text == "all") return rule;
    rule.who_ = text == "scene" ? Who::scene : text == "members" ? Who::members : Who::named;
    if (rule.who_ != Who::named) return rule;
    const auto names = parse_simulations(text);
    if (!names) return {};
    rule.named_ = *names;
    return rule;
  }
  /// The text that parse() reads.
  [[nodiscard]] std::string text() const {
    if (who_ == Who::named) return simulations_text(named_);
    return who_ == Who::members ? "members" : who_ == Who::scene ? "scene" : "all";
  }

  /// Whether the rule is meaningful only in a sealed exercise.
  [[nodiscard]] bool wants_key() const noexcept { return who_ == Who::members; }
  /// Whether only peers that announce themselves are felt.
  [[nodiscard]] bool wants_peers() const noexcept {
    return who_ == Who::members || who_ == Who::scene;
  }
  /// Index of this number in the list, 0 .. named_count() - 1; nothing if it is not listed.
  [[nodiscard]] std::optional<std::size_t> place_of(const aoim::PeerId& owner) const noexcept {
    const auto found = std::ranges::find(named_, owner);
    if (found == named_.end()) return {};
    return static_cast<std::size_t>(found - named_.begin());
  }
  [[nodiscard]] std::size_t named_count() const noexcept { return named_.size(); }
  /// @param owner of the body.
  /// @param alive whether the sender is the peer that announced itself with this number; false for
  /// a plain DIS program, see TouchGate for listed numbers
  [[nodiscard]] bool allows(const aoim::PeerId& owner, bool alive) const noexcept {
    if (who_ == Who::named) return alive && place_of(owner);
    return who_ == Who::all || alive;
  }

 private:
  enum class Who { all, scene, members, named };
  Who who_ = Who::all;
  std::vector<aoim::PeerId> named_;
};

}  // namespace reckon::peer

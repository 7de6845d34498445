// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owners whose bodies our hands and bodies feel.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

/// The `touch` of a scene. A value.
class TouchRule {
 public:
  /// All owners.
  TouchRule() = default;
  /// The rule of a scene without `touch`: "scene", or "all" with `interop`, where peers do not
  /// announce themselves.
  [[nodiscard]] static TouchRule usual(bool interop);
  /// "all", "scene" (peers that announced this scene), "members" (the same with the key of the
  /// exercise), or the numbers of permitted simulations, "1:2" or "1:2, 40:1". Nothing for any
  /// other text.
  [[nodiscard]] static std::optional<TouchRule> parse(std::string_view text);
  /// The text that parse() reads.
  [[nodiscard]] std::string text() const;

  /// Whether the rule is meaningful only in a sealed exercise.
  [[nodiscard]] bool wants_key() const noexcept { return who_ == Who::members; }
  /// Whether only peers that announce themselves are felt.
  [[nodiscard]] bool wants_peers() const noexcept {
    return who_ == Who::members || who_ == Who::scene;
  }
  /// Index of this number in the list, 0 .. named_count() - 1; nothing if it is not listed.
  [[nodiscard]] std::optional<std::size_t> place_of(const aoim::PeerId& owner) const noexcept;
  [[nodiscard]] std::size_t named_count() const noexcept { return named_.size(); }
  /// @param owner of the body.
  /// @param alive whether the sender is the peer that announced itself with this number; false for
  /// a plain DIS program, see TouchGate for listed numbers
  [[nodiscard]] bool allows(const aoim::PeerId& owner, bool alive) const noexcept;

 private:
  enum class Who { all, scene, members, named };
  Who who_ = Who::all;
  std::vector<aoim::PeerId> named_;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owners whose bodies our hands and bodies feel.
#pragma once

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
  /// "all", "members" (owners that have proved to have the key of the exercise), or the numbers of
  /// permitted peers, "1:2" or "1:2, 40:1". Nothing if the text is none of these.
  [[nodiscard]] static std::optional<TouchRule> parse(std::string_view text);
  /// The text that parse() reads.
  [[nodiscard]] std::string text() const;

  /// Whether the rule has a meaning only in a sealed exercise.
  [[nodiscard]] bool wants_key() const noexcept { return who_ == Who::members; }
  /// @param owner of the body.
  /// @param alive whether the sender is the peer that announced itself with this number; false for
  /// a plain DIS program
  [[nodiscard]] bool allows(const aoim::PeerId& owner, bool alive) const noexcept;

 private:
  enum class Who { all, members, named };
  Who who_ = Who::all;
  std::vector<aoim::PeerId> named_;
};

}  // namespace reckon::peer

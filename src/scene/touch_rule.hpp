// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whose bodies our hands and bodies feel.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

/// What `touch` of a scene says. A value.
class TouchRule {
 public:
  /// All may.
  TouchRule() = default;
  /// "all", "members" (who has proved that it has the key of the exercise), or the numbers of the
  /// peers that may, "1:2" or "1:2, 40:1". Nothing where the text is none of these.
  [[nodiscard]] static std::optional<TouchRule> parse(std::string_view text);
  /// As parse() takes it.
  [[nodiscard]] std::string text() const;

  /// Whether it means something in a sealed exercise alone.
  [[nodiscard]] bool wants_key() const noexcept { return who_ == Who::members; }
  /// @param owner of the body. @param alive a peer that announced itself under this number and is
  /// the one that speaks: a program of plain DIS is not
  [[nodiscard]] bool allows(const aoim::PeerId& owner, bool alive) const noexcept;

 private:
  enum class Who { all, members, named };
  Who who_ = Who::all;
  std::vector<aoim::PeerId> named_;
};

}  // namespace reckon::peer

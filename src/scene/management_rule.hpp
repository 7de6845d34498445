// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whose orders to stop and to go on (Stop/Freeze, Start/Resume) a peer obeys.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

/// What `allow_management` of a scene says. A value.
class ManagementRule {
 public:
  /// Nobody.
  ManagementRule() = default;
  /// "nobody", "members" (the other peers of the scene), "anyone", or the numbers of those who may,
  /// "1:2" or "1:2, 40:1", peers or programs of plain DIS. Nothing where the text is none of these.
  [[nodiscard]] static std::optional<ManagementRule> parse(std::string_view text);
  /// As parse() takes it.
  [[nodiscard]] std::string text() const;

  /// @param originator of the order. @param member a peer of the scene that speaks for itself
  [[nodiscard]] bool allows(const aoim::PeerId& originator, bool member) const noexcept;

 private:
  enum class Who { nobody, members, anyone, named };
  Who who_ = Who::nobody;
  std::vector<aoim::PeerId> named_;
};

}  // namespace reckon::peer

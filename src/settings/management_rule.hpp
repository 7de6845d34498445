// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The senders whose orders to stop and resume (Stop/Freeze, Start/Resume) a peer obeys.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

/// The `allow_management` of a scene. A value.
class ManagementRule {
 public:
  /// Nobody.
  ManagementRule() = default;
  /// "nobody", "members" (the other peers of the scene), "anyone", or the numbers of permitted
  /// peers or plain DIS programs, "1:2" or "1:2, 40:1". Nothing for any other text.
  [[nodiscard]] static std::optional<ManagementRule> parse(std::string_view text);
  /// The text that parse() reads.
  [[nodiscard]] std::string text() const;

  /// @param originator of the order.
  /// @param member whether it is a peer of the scene that sends in its own name
  [[nodiscard]] bool allows(const aoim::PeerId& originator, bool member) const noexcept;

 private:
  enum class Who { nobody, members, anyone, named };
  Who who_ = Who::nobody;
  std::vector<aoim::PeerId> named_;
};

}  // namespace reckon::peer

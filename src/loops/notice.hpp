// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sentences for the user.
#pragma once

#include <array>
#include <cstdint>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/peer/loops/sender_budget.hpp"

namespace reckon::peer {

/// Subject of a notice, for readers that collect those of one kind.
enum class NoticeKind : std::uint8_t {
  other,         ///< anything else
  joined,        ///< a peer appeared
  started_anew,  ///< a peer restarted
  left,          ///< a peer sent a farewell
  silent,        ///< a peer was silent for too long
  other_scene,   ///< a peer was not joined, because it runs another scene
  quiet,         ///< nothing is received from a peer at present
  unheard,       ///< a peer does not receive this one
  heard_again,   ///< the end of either
};

/// A sentence for the user.
struct Notice {
  std::array<char, 240> text{};  ///< printable ASCII, NUL at the end
  NoticeKind kind = NoticeKind::other;
  aoim::PeerId about{};  ///< the peer; set for all kinds but `other`
};

/// The notice of a presence event. No allocation.
[[nodiscard]] Notice notice_of(const aoim::PresenceEvent& event) noexcept;
/// The notice of a sender that is muted or received again. No allocation.
[[nodiscard]] Notice notice_of(const MutedSender& sender) noexcept;

}  // namespace reckon::peer

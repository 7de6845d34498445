// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sentences for the user.
#pragma once

#include <array>
#include <cstdint>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/peer/loops/sender_budget.hpp"

namespace reckon::peer {

/// What a notice is of, for whoever gathers those of one kind.
enum class NoticeKind : std::uint8_t {
  other,         ///< only the sentence tells
  joined,        ///< a peer came
  started_anew,  ///< a peer came back
  left,          ///< a peer said good-bye
  silent,        ///< a peer is no longer heard
  other_scene,   ///< a peer is not joined, for it runs another scene
  quiet,         ///< a peer is not heard at present
  unheard,       ///< a peer does not hear this one
  heard_again,   ///< the end of either
};

/// A sentence for the user.
struct Notice {
  std::array<char, 240> text{};  ///< printable ASCII, NUL at the end
  NoticeKind kind = NoticeKind::other;
  aoim::PeerId about{};  ///< the peer, of all kinds but `other`
};

/// What happened to whom. No allocation.
[[nodiscard]] Notice notice_of(const aoim::PresenceEvent& event) noexcept;
/// Who is muted or heard again. No allocation.
[[nodiscard]] Notice notice_of(const MutedSender& sender) noexcept;

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sentences for the user.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/peer/loops/refused_senders.hpp"
#include "reckon/peer/loops/sender_budget.hpp"

namespace reckon::peer {

/// Subject of a notice. docs/notices.md explains each.
enum class NoticeKind : std::uint8_t {
  other,
  joined,
  started_anew,
  left,
  silent,
  other_scene,
  quiet,
  unheard,
  heard_again,
  renamed,
  number_taken,
  claimed_twice,
  moved,
  impostor,
  crowd,
  slept,
  muted,
  left_out,
  interface,
  payload_cut,
  base_unjoined,
  groups_unjoined,
  send_fails,
  held_back,
  kernel_drops,
  groups_capped,
  peers_full,
  numberings_full,
  nothing_near,
  frozen,
  order_refused,
  name_disputed,
  touch_refused,
  body_disputed,
  bodies_adopted,
  bodies_rest,
  worlds_met,
  inside_hand,
  rows_evicted,
  strangers_full,
  presses,
  body_silent,
  hands_silent,
  softened,
  crowded,
  table_full,
  write_full,
  read_waits,
  sealed,
  datagrams_refused,
  model_refused,
  clock_leap,
  lost,
  stretched,
  budget_unmet,
  budget_cut,
  leader,
  beacon,
  beacon_disputed,
  effect,
  number_held,
  servo_slow,
  key,
  device,
  undelivered,
  scene_not_offered,
};

enum class Severity : std::uint8_t { info, warning, error };

/// Properties common to all notices of a kind.
struct NoticeFacts {
  std::string_view id;  ///< stable, for programs that read notices
  Severity severity;    ///< of the notice that begins a condition; the one that ends it has `info`
  std::string_view meaning;
};

[[nodiscard]] const NoticeFacts& facts_of(NoticeKind kind) noexcept;
[[nodiscard]] std::string_view name_of(Severity severity) noexcept;
/// All rows, in the order of NoticeKind.
[[nodiscard]] std::span<const NoticeFacts> all_notice_facts() noexcept;

/// A sentence for the user.
struct Notice {
  std::array<char, 240> text{};  ///< printable ASCII, NUL at the end
  NoticeKind kind = NoticeKind::other;
  Severity severity = Severity::info;
  aoim::PeerId about{};  ///< the peer of a presence event, if that is the cause
};

/// The notice of a presence event. No allocation.
[[nodiscard]] Notice notice_of(const aoim::PresenceEvent& event) noexcept;
/// The notice for a sender that is muted or unmuted. No allocation.
[[nodiscard]] Notice notice_of(const MutedSender& sender) noexcept;
/// The notice for a sender whose datagrams are refused. @param interop whether the exercise is
/// plain DIS. No allocation.
[[nodiscard]] Notice notice_of(const RefusedSender& sender, bool interop) noexcept;

}  // namespace reckon::peer

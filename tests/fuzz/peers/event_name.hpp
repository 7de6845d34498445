// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of presence events, for the event log of a seed.
#pragma once

#include <array>
#include <string_view>

#include "reckon/aoim/presence/presence_event.hpp"

namespace reckon::fuzz {

/// "timed out".
[[nodiscard]] constexpr std::string_view name_of(aoim::PresenceEventKind kind) noexcept {
  constexpr std::array<std::string_view, 17> kNames{
      "newcomer", "restarted",  "renamed",        "moved",
      "departed", "timed out",  "scene mismatch", "identity changed",
      "settled",  "heard late", "disputed",       "impostor",
      "crowd",    "quiet",      "unheard",        "heard again",
      "slept"};
  static_assert(static_cast<std::size_t>(aoim::PresenceEventKind::slept) + 1 == kNames.size());
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace reckon::fuzz

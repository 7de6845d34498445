// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/event_name.hpp"

namespace reckon::fuzz {

std::string_view name_of(aoim::PresenceEventKind kind) noexcept {
  using enum aoim::PresenceEventKind;
  switch (kind) {
    case newcomer:
      return "newcomer";
    case restarted:
      return "restarted";
    case renamed:
      return "renamed";
    case departed:
      return "departed";
    case timed_out:
      return "timed out";
    case scene_mismatch:
      return "scene mismatch";
    case identity_changed:
      return "identity changed";
    case settled:
      return "settled";
    case heard_late:
      return "heard late";
    case disputed:
      return "disputed";
    case moved:
      return "moved";
    case impostor:
      return "impostor";
    case crowd:
      return "crowd";
    case quiet:
      return "quiet";
    case unheard:
      return "unheard";
    case heard_again:
      return "heard again";
    case slept:
      return "slept";
  }
  return "unknown";
}

}  // namespace reckon::fuzz

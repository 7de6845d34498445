// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/mailbox.hpp"

namespace reckon::peer {

void Wishes::clear() noexcept {
  registered.clear();
  moved.clear();
  appearances.clear();
  parts.clear();
  removed.clear();
  said.clear();
  octets.clear();
}

void News::clear() noexcept {
  states.clear();
  removed.clear();
  heard.clear();
  octets.clear();
}

}  // namespace reckon::peer

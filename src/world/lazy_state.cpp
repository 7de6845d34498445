// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/lazy_state.hpp"

#include <utility>

#include "reckon/deadreckon/wire_conversion.hpp"

namespace reckon::peer {

void LazyState::look() const noexcept {
  seen_ = true;
  const deadreckon::LocalFrame* frame = std::exchange(frame_, nullptr);
  if (frame != nullptr) state_.orientation = deadreckon::orientation_from_wire(wire_, *frame);
}

}  // namespace reckon::peer

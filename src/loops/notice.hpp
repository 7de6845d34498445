// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sentences for the user.
#pragma once

#include <array>

#include "reckon/aoim/presence.hpp"

namespace reckon::peer {

/// A sentence for the user.
struct Notice {
  std::array<char, 160> text{};  ///< NUL at the end
};

/// What happened to whom. No allocation.
[[nodiscard]] Notice notice_of(const aoim::PresenceEvent& event) noexcept;

}  // namespace reckon::peer

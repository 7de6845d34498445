// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of what presence tells, for the story of a seed.
#pragma once

#include <string_view>

#include "reckon/aoim/presence/presence.hpp"

namespace reckon::fuzz {

[[nodiscard]] std::string_view name_of(aoim::PresenceEventKind kind) noexcept;

}  // namespace reckon::fuzz

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a verb that serves its own page says of it.
#pragma once

#include "reckon/tools/exercise/live_display.hpp"
#include "reckon/tools/viewer/self_view.hpp"

namespace reckon::tools {

/// Puts the page's address in the display's head, and among its notices whom else it lets in.
void show_address(const SelfView& view, bool has_key, LiveDisplay& display);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports the address of a verb's page.
#pragma once

#include "reckon/tools/exercise/live_display.hpp"
#include "reckon/tools/viewer/self_view.hpp"

namespace reckon::tools {

/// Shows the page's address in the display's head, and access by other hosts among its notices.
inline void show_address(const SelfView& view, bool has_key, LiveDisplay& display) {
  display.put_in_head("page: " + view.address());
  if (!view.addresses_for_others().empty())
    display.add(invitation(view.addresses_for_others(), has_key));
}

}  // namespace reckon::tools

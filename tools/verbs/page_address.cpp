// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/page_address.hpp"

#include "reckon/tools/viewer/viewing.hpp"

namespace reckon::tools {

void show_address(const SelfView& view, const ViewFlags& flags, LiveDisplay& display) {
  display.put_in_head("page: " + view.address());
  if (!view.addresses_for_others().empty()) display.add(invitation(view.addresses_for_others()));
  if (flags.open) open_browser(view.address());
}

}  // namespace reckon::tools

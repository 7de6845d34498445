// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/page_address.hpp"

namespace reckon::tools {

void show_address(const SelfView& view, bool has_key, LiveDisplay& display) {
  display.put_in_head("page: " + view.address());
  if (!view.addresses_for_others().empty())
    display.add(invitation(view.addresses_for_others(), has_key));
}

}  // namespace reckon::tools

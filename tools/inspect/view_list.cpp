// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/view_list.hpp"

#include <algorithm>
#include <array>

namespace reckon::tools {
namespace view {

// One function for each view, defined in the file of its class.
InspectViewKind tail();
InspectViewKind stats();
InspectViewKind check();
InspectViewKind bundles();
InspectViewKind haptics();
InspectViewKind top();

}  // namespace view

/// THE list of views.
std::span<const InspectViewKind> inspect_views() {
  static const std::array kViews{view::tail(),    view::stats(),   view::check(),
                                 view::bundles(), view::haptics(), view::top()};
  return kViews;
}

const InspectViewKind& inspect_view_kind(std::string_view name) {
  const auto found = std::ranges::find(inspect_views(), name, &InspectViewKind::name);
  return found == inspect_views().end() ? inspect_views().front() : *found;
}

}  // namespace reckon::tools

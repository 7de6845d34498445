// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/view_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "reckon/peer/notation/nearest_word.hpp"

namespace reckon::tools {
namespace view {

// One function for each view, defined in the file of its class.
InspectViewKind tail();
InspectViewKind stats();
InspectViewKind check();
InspectViewKind bundles();
InspectViewKind haptics();
InspectViewKind top();
InspectViewKind emissions();
InspectViewKind owners();

}  // namespace view

/// THE list of views.
std::span<const InspectViewKind> inspect_views() {
  static const std::array kViews{view::tail(),    view::stats(), view::check(),     view::bundles(),
                                 view::haptics(), view::top(),   view::emissions(), view::owners()};
  return kViews;
}

const InspectViewKind& inspect_view_kind(std::string_view name) {
  const auto found = std::ranges::find(inspect_views(), name, &InspectViewKind::name);
  return found == inspect_views().end() ? inspect_views().front() : *found;
}

void sort_inspect_words(InspectOptions& options) {
  const auto is_view = [](std::string_view word) { return inspect_view_kind(word).name == word; };
  std::string& source = options.source.source;
  if (!is_view(options.view) && is_view(source)) std::swap(options.view, source);
  if (options.view.empty() || is_view(options.view)) return;
  std::vector<std::string_view> names;
  for (const InspectViewKind& kind : inspect_views()) names.push_back(kind.name);
  const std::string_view nearest = peer::nearest_word(options.view, names);
  throw UsageError(
      fmt::format("VIEW: '{}' is not one of {}{}", options.view, fmt::join(names, ", "),
                  nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

std::string views_with_csv() {
  std::string names;
  for (const InspectViewKind& kind : inspect_views())
    if (kind.takes_csv) names += fmt::format("{}{}", names.empty() ? "" : ", ", kind.name);
  return names;
}

}  // namespace reckon::tools

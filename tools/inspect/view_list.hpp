// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The inspector's views by name; THE list is in view_list.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "reckon/tools/inspect/output/options.hpp"
#include "reckon/tools/inspect/output/view.hpp"

namespace reckon::tools {

/// All views, in the order of --help.
[[nodiscard]] std::span<const InspectViewKind> inspect_views();

/// The kind with that name, or the first row if there is none.
[[nodiscard]] const InspectViewKind& inspect_view_kind(std::string_view name);

/// Assigns the words SOURCE and VIEW of a command line, which may come in either order. A view
/// alone selects the live groups.
/// @throws UsageError if neither is a view
void sort_inspect_words(InspectOptions& options);

/// "stats, check, bundles": the views that are tables.
[[nodiscard]] std::string views_with_csv();

}  // namespace reckon::tools

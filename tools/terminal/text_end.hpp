// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output iterator for fmt::format_to that appends to a text.
#pragma once

#include <iterator>
#include <string>

namespace reckon::tools {

/// An iterator that appends to `text`, which outlives it.
[[nodiscard]] inline auto end_of(std::string& text) { return std::back_inserter(text); }

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A page whose tables can be sorted, and whose dominated rows can be hidden.
#pragma once

#include <string>
#include <string_view>

namespace reckon::bench {

/// As html_page(), readable without its script. Each <section> of the body has one <table>; rows of
/// class d are dominated and can be hidden, columns can be sorted.
[[nodiscard]] std::string sortable_page(std::string_view title, std::string_view style,
                                        std::string_view body);
/// A cell that is sorted by a value other than its text.
[[nodiscard]] std::string page_cell(double value, const std::string& text);

}  // namespace reckon::bench

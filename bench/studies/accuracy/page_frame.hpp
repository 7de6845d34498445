// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the pages of the studies have in common: style, script and the parts of tables. A page is
// one file that needs no network, readable in light and dark, and without the script.
#pragma once

#include <string>
#include <string_view>

namespace reckon::bench {

/// Head and style, up to the open body. Each <section> has one <table>; rows of class d are
/// dominated and can be hidden, columns can be sorted.
[[nodiscard]] std::string page_begin(std::string_view title);
/// Script and end.
[[nodiscard]] std::string page_end();
/// A cell that is sorted by a value other than its text.
[[nodiscard]] std::string page_cell(double value, const std::string& text);
/// Text as it may stand in an element or an attribute of a page.
[[nodiscard]] std::string html_text(std::string_view text);

}  // namespace reckon::bench

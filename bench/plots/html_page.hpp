// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The frame of a page that needs no other file: head, colours of light and dark and of print.
#pragma once

#include <string>
#include <string_view>

namespace reckon::bench {

/// `text` of any origin as HTML may hold it, in a tag's attribute too.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// The whole page. @param style CSS behind that of all pages; `body` HTML below the title
[[nodiscard]] std::string html_page(std::string_view title, std::string_view style,
                                    std::string_view body);

}  // namespace reckon::bench

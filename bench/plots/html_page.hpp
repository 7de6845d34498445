// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The frame of a page that needs no other file: head, and colours for light, dark and print.
#pragma once

#include <string>
#include <string_view>

namespace reckon::bench {

/// `text` of any content, escaped for HTML, including attributes.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// The complete page. @param style CSS after the CSS of all pages; `body` HTML below the title
[[nodiscard]] std::string html_page(std::string_view title, std::string_view style,
                                    std::string_view body);

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The files of the page, which are compiled into the program.
#pragma once

#include <string_view>

namespace reckon::tools {

/// A file for an HTTP answer.
struct PageFile {
  std::string_view path;  ///< "/page.css"; the page itself is "/", its frame "/frame.html"
  std::string_view content_type;
  std::string_view gzip;  ///< its octets, compressed by gzip; empty: sent plain
  std::string_view text;  ///< the same, plain
};

/// The file that a request names; null if the page has none.
[[nodiscard]] const PageFile* find_page_file(std::string_view path);

}  // namespace reckon::tools

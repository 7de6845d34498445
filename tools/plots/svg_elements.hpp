// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Elements of the SVG pictures.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

#include "reckon/tools/plots/markup.hpp"

namespace reckon::tools {

constexpr double kSvgNoteRow = 17;  ///< height of a note line below a title [px]

/// Appends `text` escaped for SVG: octets outside printable ASCII become question marks.
inline void append_svg_escaped(std::string& out, std::string_view text) {
  for (const char letter : text) {
    const auto octet = static_cast<unsigned char>(letter);
    const char shown = octet < 0x20 || octet > 0x7E ? '?' : letter;
    append_escaped(out, {&shown, 1});
  }
}

/// `attributes`: empty, or beginning with a blank.
inline void append_svg_text(std::string& out, double x, double y, std::string_view attributes,
                            std::string_view text) {
  fmt::format_to(std::back_inserter(out), "<text x=\"{:.1f}\" y=\"{:.1f}\"{}>", x, y, attributes);
  append_svg_escaped(out, text);
  out += "</text>\n";
}

/// `kind`: its class in the style of the picture.
inline void append_svg_line(std::string& out, std::string_view kind, double x1, double y1,
                            double x2, double y2) {
  fmt::format_to(std::back_inserter(out),
                 "<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n",
                 kind, x1, y1, x2, y2);
}

/// A whole file around its elements: size [px], and the style of texts (.t title, .m heading) and
/// lines (.g grid, .a axis) on light and dark pages.
inline std::string svg_picture(std::string_view inside, double width, double height) {
  constexpr std::string_view kStyle =
      "<style>text{font:12px system-ui,sans-serif;fill:#24292f}.t{font-size:15px;font-weight:600}"
      ".m{font-weight:600}.g{stroke:#d8dee4}.a{stroke:#57606a}.b{fill:#ffffff}"
      "@media(prefers-color-scheme:dark){text{fill:#d0d7de}.g{stroke:#30363d}.a{stroke:#8b949e}"
      ".b{fill:#0d1117}}</style>\n";
  std::string out;
  fmt::format_to(std::back_inserter(out),
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" "
                 "width=\"{0:g}\" height=\"{1:g}\">\n{2}"
                 "<rect class=\"b\" width=\"{0:g}\" height=\"{1:g}\"/>\n{3}</svg>\n",
                 width, height, kStyle, inside);
  return out;
}

}  // namespace reckon::tools

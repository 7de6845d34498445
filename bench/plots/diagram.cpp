// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/plots/diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reckon/tools/plots/svg_elements.hpp"
#include "reckon/tools/terminal/text_end.hpp"

namespace reckon::bench {
namespace {

constexpr double kRow = 15;  // of text
constexpr double kLeft = 24;
constexpr double kEdge = 16;  // below everything
constexpr std::string_view kStyle =
    "<style>.n{fill:#f6f8fa;stroke:#57606a;stroke-width:1.3}.w{fill:none;stroke:#24292f;stroke-"
    "width:1.3}.h{fill:#24292f}.f{fill:none;stroke:#8b949e;stroke-dasharray:5 "
    "4}@media(prefers-color-scheme:dark){.n{fill:#161b22;stroke:#8b949e}.w{stroke:#d0d7de}.h{fill:#"
    "d0d7de}.f{stroke:#57606a}}</style>\n"
    "<defs><marker id=\"head\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"8\" "
    "markerHeight=\"8\" orient=\"auto\"><path class=\"h\" d=\"M0 1L10 5L0 9z\"/></marker></defs>\n";

}  // namespace

void Diagram::reach(double y) { height_ = std::max(height_, y); }

void Diagram::append_lines(double x, double y, std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    tools::append_svg_text(inside_, x, y, " text-anchor=\"middle\"", text.substr(0, end));
    reach(y);
    y += kRow;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

Diagram::Node Diagram::shape(double x, double y, double width, double height, bool is_round,
                             std::string_view kind) {
  const double corner = is_round ? 0.5 * height : 6;
  fmt::format_to(
      tools::end_of(inside_),
      "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:g}\" height=\"{:g}\" rx=\"{:g}\"/>\n",
      kind, x - 0.5 * width, y - 0.5 * height, width, height, corner);
  reach(y + 0.5 * height);
  return {{x, y}, width, height};
}

Diagram::Node Diagram::box(double x, double y, std::string_view text, double width, double height) {
  const Node node = shape(x, y, width, height, false, "n");
  const auto rows = static_cast<double>(std::ranges::count(text, '\n'));
  append_lines(x, y + 4 - 0.5 * kRow * rows, text);
  return node;
}

Diagram::Node Diagram::ellipse(double x, double y, std::string_view text, double width,
                               double height) {
  const Node node = shape(x, y, width, height, true, "n");
  const auto rows = static_cast<double>(std::ranges::count(text, '\n'));
  append_lines(x, y + 4 - 0.5 * kRow * rows, text);
  return node;
}

Diagram::Node Diagram::sum(double x, double y) {
  const Node node = shape(x, y, 24, 24, true, "n");
  append_lines(x, y + 4, "+");
  return node;
}

Diagram::Node Diagram::dot(double x, double y) { return shape(x, y, 6, 6, true, "h"); }

Diagram::Node Diagram::frame(double x, double y, std::string_view name, double width,
                             double height) {
  const Node node = shape(x, y, width, height, false, "f");
  append_lines(x, y - 0.5 * height + 16, name);
  return node;
}

void Diagram::text(double x, double y, std::string_view text) { append_lines(x, y, text); }

void Diagram::way(std::initializer_list<Place> places, std::string_view label, bool has_head) {
  fmt::format_to(tools::end_of(inside_), "<polyline class=\"w\"{} points=\"",
                 has_head ? " marker-end=\"url(#head)\"" : "");
  const Place* longest = nullptr;
  double most = -1;
  for (const Place* place = places.begin(); place != places.end(); ++place) {
    fmt::format_to(tools::end_of(inside_), "{:.1f},{:.1f} ", place->x, place->y);
    reach(place->y);
    if (place + 1 == places.end()) continue;
    const double length = std::hypot(place[1].x - place->x, place[1].y - place->y);
    if (length > most) {
      most = length;
      longest = place;
    }
  }
  inside_ += "\"/>\n";
  if (label.empty() || longest == nullptr) return;
  const Place a = longest[0], b = longest[1];
  const double x = 0.5 * (a.x + b.x), y = 0.5 * (a.y + b.y);
  const bool upright = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  tools::append_svg_text(inside_, upright ? x + 7 : x, upright ? y + 4 : y - 7,
                         upright ? "" : " text-anchor=\"middle\"", label);
}

void Diagram::arrow(std::initializer_list<Place> places, std::string_view label) {
  way(places, label, true);
}

void Diagram::line(std::initializer_list<Place> places, std::string_view label) {
  way(places, label, false);
}

std::string Diagram::svg(std::string_view title, std::span<const std::string> notes) const {
  std::string inside(kStyle);
  tools::append_svg_text(inside, kLeft, 26, " class=\"t\"", title);
  double top = 46;
  for (const std::string& note : notes) {
    tools::append_svg_text(inside, kLeft, top, "", note);
    top += tools::kSvgNoteRow;
  }
  fmt::format_to(tools::end_of(inside), "<g transform=\"translate(0 {:g})\">\n{}</g>\n", top,
                 inside_);
  return tools::svg_picture(inside, kWidth, top + height_ + kEdge);
}

}  // namespace reckon::bench

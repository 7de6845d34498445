// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A block diagram as a self-contained SVG picture in the style of the curves: boxes, sums and the
// lines between them, each at a given place.
//
//   Diagram diagram;
//   const auto plant = diagram.box(300, 60, "1/(m s + b)");
//   diagram.arrow({{100, 60}, plant.left()}, "f");
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace reckon::bench {

/// Places in px: x to the right, 0 to kWidth; y down from below title and notes.
class Diagram {
 public:
  static constexpr double kWidth = 760;

  struct Place {
    double x = 0, y = 0;
  };

  /// End points of lines.
  struct Node {
    Place middle;
    double width = 0, height = 0;

    [[nodiscard]] Place left(double down = 0) const { return at(-0.5 * width, down); }
    [[nodiscard]] Place right(double down = 0) const { return at(0.5 * width, down); }
    [[nodiscard]] Place top(double right = 0) const { return at(right, -0.5 * height); }
    [[nodiscard]] Place bottom(double right = 0) const { return at(right, 0.5 * height); }
    [[nodiscard]] Place at(double right, double down) const {
      return {middle.x + right, middle.y + down};
    }
  };

  /// @param text lines of any text
  Node box(double x, double y, std::string_view text, double width = 120, double height = 44);
  Node ellipse(double x, double y, std::string_view text, double width = 96, double height = 40);
  Node sum(double x, double y);  ///< a circle with a plus
  Node dot(double x, double y);  ///< where lines join or split
  /// A frame around others, with a name at its upper edge.
  Node frame(double x, double y, std::string_view name, double width, double height);
  void text(double x, double y, std::string_view text);  ///< centred on x, first line at y

  /// @param label at the middle of the longest piece: above a horizontal one, right of a vertical
  ///     one
  void arrow(std::initializer_list<Place> way, std::string_view label = "");
  void line(std::initializer_list<Place> way, std::string_view label = "");

  /// The complete file.
  [[nodiscard]] std::string svg(std::string_view title, std::span<const std::string> notes) const;

 private:
  Node shape(double x, double y, double width, double height, bool is_round, std::string_view kind);
  void append_lines(double x, double y, std::string_view text);
  void way(std::initializer_list<Place> places, std::string_view label, bool has_head);
  void reach(double y);

  std::string inside_;
  double height_ = 0;
};

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What goes to a terminal and what comes from it, without saying how: lines and keys.
#pragma once

#include <cstdint>
#include <string>

namespace reckon::tools {

enum class LineStyle : std::uint8_t { plain, title, selected, bad, faint };

/// One row of the screen; UTF-8 without control characters.
struct ScreenLine {
  std::string text;
  LineStyle style = LineStyle::plain;
};

struct ScreenSize {
  std::size_t rows = 24;
  std::size_t columns = 80;
  friend bool operator==(const ScreenSize&, const ScreenSize&) = default;
};

enum class Key : std::uint8_t {
  character,
  up,
  down,
  left,
  right,
  page_up,
  page_down,
  home,
  end,
  enter,
  escape,
  backspace,
  resize  ///< no key: the terminal has another size now
};

struct KeyPress {
  Key key = Key::character;
  char letter = '\0';  ///< of Key::character: printable ASCII
};

}  // namespace reckon::tools

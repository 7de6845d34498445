// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Input and output of a terminal, independent of its driver: lines and keys.
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
  resize  ///< not a key: the size of the terminal has changed
};

struct KeyPress {
  Key key = Key::character;
  char letter = '\0';  ///< of Key::character: printable ASCII
};

}  // namespace reckon::tools

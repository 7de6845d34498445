// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/screen.hpp"

#include <unistd.h>

#include <clocale>

// Its macros have names as common as "clear" and "timeout".
#define NCURSES_NOMACROS
#include <ncurses.h>

namespace reckon::tools {
namespace {

constexpr int kEscapeDelay_ms = 25;  // after it, an Escape is no beginning of a key's sequence
constexpr int kAsciiDelete = 127;
constexpr int kAsciiEscape = 27;
constexpr short kBadColour = 1;

std::optional<Key> special_key(int code) {
  switch (code) {
    case KEY_UP:
      return Key::up;
    case KEY_DOWN:
      return Key::down;
    case KEY_LEFT:
      return Key::left;
    case KEY_RIGHT:
      return Key::right;
    case KEY_PPAGE:
      return Key::page_up;
    case KEY_NPAGE:
      return Key::page_down;
    case KEY_HOME:
      return Key::home;
    case KEY_END:
      return Key::end;
    case KEY_ENTER:
    case '\n':
    case '\r':
      return Key::enter;
    case kAsciiEscape:
      return Key::escape;
    case KEY_BACKSPACE:
    case kAsciiDelete:
    case '\b':
      return Key::backspace;
    case KEY_RESIZE:
      return Key::resize;
    default:
      return std::nullopt;
  }
}

attr_t attributes_of(LineStyle style, bool colour) {
  switch (style) {
    case LineStyle::title:
      return A_BOLD;
    case LineStyle::selected:
      return A_REVERSE;
    case LineStyle::bad:
      return colour ? static_cast<attr_t>(COLOR_PAIR(kBadColour)) : A_BOLD;
    case LineStyle::faint:
      return A_DIM;
    case LineStyle::plain:
      break;
  }
  return A_NORMAL;
}

}  // namespace

struct TerminalScreen::State {
  SCREEN* screen;
  bool colour;
};

std::unique_ptr<TerminalScreen> TerminalScreen::open(std::FILE* out, bool colour) {
  if (isatty(fileno(out)) != 1 || isatty(STDIN_FILENO) != 1) return nullptr;
  std::setlocale(LC_CTYPE, "");  // so that it knows whether the terminal takes UTF-8
  set_escdelay(kEscapeDelay_ms);
  SCREEN* screen = newterm(nullptr, out, stdin);
  if (screen == nullptr) return nullptr;
  auto state = std::make_unique<State>(State{screen, colour && has_colors()});
  return std::unique_ptr<TerminalScreen>(new TerminalScreen(std::move(state)));
}

TerminalScreen::TerminalScreen(std::unique_ptr<State> state) : state_(std::move(state)) {
  set_term(state_->screen);
  cbreak();
  noecho();
  keypad(stdscr, TRUE);
  nodelay(stdscr, TRUE);
  curs_set(0);
  if (!state_->colour) return;
  start_color();
  use_default_colors();
  init_pair(kBadColour, COLOR_RED, -1);
}

TerminalScreen::~TerminalScreen() {
  endwin();
  delscreen(state_->screen);
}

ScreenSize TerminalScreen::size() const {
  return {static_cast<std::size_t>(getmaxy(stdscr)), static_cast<std::size_t>(getmaxx(stdscr))};
}

std::optional<KeyPress> TerminalScreen::key() {
  for (int code = wgetch(stdscr); code != ERR; code = wgetch(stdscr)) {
    if (const auto special = special_key(code)) return KeyPress{*special};
    if (code >= ' ' && code <= '~') return KeyPress{Key::character, static_cast<char>(code)};
  }
  return std::nullopt;
}

void TerminalScreen::show(std::span<const ScreenLine> lines) {
  werase(stdscr);
  const ScreenSize room = size();
  for (std::size_t i = 0; i < lines.size() && i < room.rows; ++i) {
    wattrset(stdscr, static_cast<int>(attributes_of(lines[i].style, state_->colour)));
    mvwaddnstr(stdscr, static_cast<int>(i), 0, lines[i].text.data(),
               static_cast<int>(lines[i].text.size()));
  }
  wattrset(stdscr, static_cast<int>(A_NORMAL));
  wrefresh(stdscr);
}

}  // namespace reckon::tools

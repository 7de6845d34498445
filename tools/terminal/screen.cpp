// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/screen.hpp"

#include <termios.h>
#include <unistd.h>

#include <clocale>
#include <string>

#include "reckon/tools/terminal/signal_guard.hpp"

// The macros of ncurses have common names such as "clear", "timeout" and "lines".
#define NCURSES_NOMACROS
#include <ncurses.h>
#include <term.h>
#undef columns
#undef lines

namespace reckon::tools {
namespace {

constexpr int kEscapeDelay_ms = 25;  // after it, an Escape is a separate key
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

/// State for a signal handler that restores the terminal: there is only one terminal.
struct Shared {
  int descriptor = -1;
  termios before{};
  std::string farewell;  // leaves the screen, shows the cursor
};
Shared shared;

void give_back() {
  const auto written = write(shared.descriptor, shared.farewell.data(), shared.farewell.size());
  static_cast<void>(written);  // an error cannot be reported here
  tcsetattr(shared.descriptor, TCSANOW, &shared.before);
}

// Without padding marks ($<..>), which present terminals do not need.
std::string capability(const char* name) {
  const char* text = tigetstr(name);
  if (text == nullptr || text == reinterpret_cast<const char*>(-1)) return {};
  std::string all(text);
  for (std::size_t mark = all.find("$<"); mark != all.npos; mark = all.find("$<", mark))
    all.erase(mark, all.find('>', mark) - mark + 1);
  return all;
}

/// Whether TERM supports drawing in place: not "dumb" or unknown.
bool can_draw(int descriptor) {
  int found = 0;
  if (setupterm(nullptr, descriptor, &found) != OK) return false;
  const bool can = !capability("cup").empty() && !capability("clear").empty();
  del_curterm(cur_term);
  return can;
}

}  // namespace

struct TerminalScreen::Terminal {
  explicit Terminal(SCREEN* opened, bool wants_colour)
      : screen(opened),
        colour(wants_colour && has_colors()),
        guard(give_back, FirstRequest::leaves_it, false) {}

  SCREEN* screen;
  bool colour;
  SignalGuard guard;  // ncurses itself restores the terminal for Ctrl-Z
};

std::unique_ptr<TerminalScreen> TerminalScreen::open(std::FILE* out, bool colour) {
  const int descriptor = fileno(out);
  if (isatty(descriptor) != 1 || isatty(STDIN_FILENO) != 1) return nullptr;
  if (!in_foreground(descriptor) || !can_draw(descriptor)) return nullptr;
  std::setlocale(LC_CTYPE, "");  // for ncurses: whether the terminal uses UTF-8
  set_escdelay(kEscapeDelay_ms);
  shared.descriptor = descriptor;
  tcgetattr(descriptor, &shared.before);
  SCREEN* screen = newterm(nullptr, out, stdin);
  if (screen == nullptr) return nullptr;
  shared.farewell =
      capability("sgr0") + capability("rmkx") + capability("cnorm") + capability("rmcup");
  auto terminal = std::make_unique<Terminal>(screen, colour);
  return std::unique_ptr<TerminalScreen>(new TerminalScreen(std::move(terminal)));
}

TerminalScreen::TerminalScreen(std::unique_ptr<Terminal> terminal)
    : terminal_(std::move(terminal)) {
  set_term(terminal_->screen);
  cbreak();
  noecho();
  keypad(stdscr, TRUE);
  nodelay(stdscr, TRUE);
  curs_set(0);
  if (!terminal_->colour) return;
  start_color();
  use_default_colors();
  init_pair(kBadColour, COLOR_RED, -1);
}

TerminalScreen::~TerminalScreen() {
  endwin();
  delscreen(terminal_->screen);
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
    wattrset(stdscr, static_cast<int>(attributes_of(lines[i].style, terminal_->colour)));
    mvwaddnstr(stdscr, static_cast<int>(i), 0, lines[i].text.data(),
               static_cast<int>(lines[i].text.size()));
  }
  wattrset(stdscr, static_cast<int>(A_NORMAL));
  wrefresh(stdscr);
}

}  // namespace reckon::tools

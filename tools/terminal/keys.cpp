// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/keys.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <ctime>

namespace reckon::tools {
namespace {

/// State for a signal handler: there is only one terminal.
struct Shared {
  int descriptor = -1;
  termios before{};
  volatile std::sig_atomic_t taken = 0;  ///< the terminal is in key mode
};
Shared shared;

void restore_terminal() {
  if (shared.taken == 0) return;
  shared.taken = 0;
  tcsetattr(shared.descriptor, TCSANOW, &shared.before);
}

/// Does nothing after a signal has requested the end; after Ctrl-Z the next read() calls it again.
void take_terminal() {
  if (shared.taken != 0 || SignalGuard::has_ended() || !in_foreground(shared.descriptor)) return;
  SignalGuard::undisturbed([] {
    termios mode = shared.before;
    mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    mode.c_cc[VMIN] = 0;
    mode.c_cc[VTIME] = 0;
    shared.taken = 1;
    tcsetattr(shared.descriptor, TCSANOW, &mode);
  });
}

void sleep_for(std::chrono::nanoseconds time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  const timespec limit{seconds.count(), (time - seconds).count()};
  nanosleep(&limit, nullptr);
}

}  // namespace

TerminalKeys::TerminalKeys(int descriptor)
    : descriptor_(descriptor),
      active_(descriptor >= 0 && shared.descriptor < 0 && isatty(descriptor) == 1 &&
              tcgetattr(descriptor, &shared.before) == 0) {
  if (!active_) return;
  shared.descriptor = descriptor;
  guard_.emplace(restore_terminal, FirstRequest::gives_back, true);
  take_terminal();
}

TerminalKeys::~TerminalKeys() {
  if (!active_) return;
  restore_terminal();
  guard_.reset();
  shared.descriptor = -1;
}

std::size_t TerminalKeys::read(std::span<char> out, std::chrono::nanoseconds patience) {
  patience = std::max(patience, std::chrono::nanoseconds{0});
  if (active_) take_terminal();
  if (!active_ || shared.taken == 0) {
    if (patience.count() > 0) sleep_for(patience);
    return 0;
  }
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(patience);
  const timespec limit{seconds.count(), (patience - seconds).count()};
  pollfd entry{descriptor_, POLLIN, 0};
  if (ppoll(&entry, 1, &limit, nullptr) <= 0) return 0;
  const ssize_t count = ::read(descriptor_, out.data(), out.size());
  if (count > 0) return static_cast<std::size_t>(count);
  // A closed terminal is always ready: without the wait, callers would loop.
  if (patience.count() > 0) sleep_for(patience);
  return 0;
}

}  // namespace reckon::tools

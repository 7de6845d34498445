// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/keys.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <ctime>

namespace reckon::tools {
namespace {

/// What ends or stops a program while it holds the terminal.
constexpr std::array kSignals{SIGINT, SIGTERM, SIGQUIT, SIGHUP, SIGABRT, SIGTSTP};

/// What a signal handler needs: there is one terminal.
struct Shared {
  int descriptor = -1;
  termios before{};
  volatile std::sig_atomic_t taken = 0;  ///< the terminal is in our mode
  volatile std::sig_atomic_t ended = 0;  ///< a signal asked for the end: not to be taken again
  std::array<struct sigaction, kSignals.size()> actions{};
};
Shared shared;

void restore_terminal() {
  if (shared.taken == 0) return;
  shared.taken = 0;
  tcsetattr(shared.descriptor, TCSANOW, &shared.before);
}

/// Gives the terminal back first. The first Ctrl-C or SIGTERM then goes to the program's own
/// handler, which ends it in good order; everything else does what it would have done.
extern "C" void give_back_and_go_on(int signal) {
  restore_terminal();
  if (signal == SIGTSTP) {
    (void)raise(SIGSTOP);  // the next read() takes the terminal again
    return;
  }
  const auto place = std::find(kSignals.begin(), kSignals.end(), signal) - kSignals.begin();
  const struct sigaction& action = shared.actions[static_cast<std::size_t>(place)];
  const bool has_handler = action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN &&
                           (action.sa_flags & SA_SIGINFO) == 0;
  if (has_handler && shared.ended == 0) {
    shared.ended = 1;
    action.sa_handler(signal);
    return;
  }
  if (action.sa_handler == SIG_IGN) return;
  (void)std::signal(signal, SIG_DFL);
  (void)raise(signal);  // takes effect when this handler returns
}

/// A program in the background must not touch the terminal: it would be stopped.
bool in_foreground(int descriptor) {
  const pid_t group = tcgetpgrp(descriptor);
  return group < 0 || group == getpgrp();
}

/// No signal may come between the two lines that belong together.
void take_terminal() {
  if (shared.taken != 0 || shared.ended != 0 || !in_foreground(shared.descriptor)) return;
  sigset_t signals;
  sigset_t before;
  sigemptyset(&signals);
  for (const int signal : kSignals) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, &before);
  termios mode = shared.before;
  mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  mode.c_cc[VMIN] = 0;
  mode.c_cc[VTIME] = 0;
  shared.taken = 1;
  tcsetattr(shared.descriptor, TCSANOW, &mode);
  sigprocmask(SIG_SETMASK, &before, nullptr);
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
  shared.ended = 0;
  struct sigaction action {};
  action.sa_handler = give_back_and_go_on;
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    sigaction(kSignals[i], &action, &shared.actions[i]);
  take_terminal();
}

TerminalKeys::~TerminalKeys() {
  if (!active_) return;
  restore_terminal();
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    sigaction(kSignals[i], &shared.actions[i], nullptr);
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
  // A terminal that is gone would be ready at once, for ever.
  if (patience.count() > 0) sleep_for(patience);
  return 0;
}

}  // namespace reckon::tools

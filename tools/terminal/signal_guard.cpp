// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/terminal/signal_guard.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <csignal>

namespace reckon::tools {
namespace {

/// Signals that end a program while it uses the terminal; the last one stops it.
constexpr std::array kSignals{SIGINT,  SIGTERM, SIGQUIT, SIGHUP, SIGABRT,
                              SIGSEGV, SIGBUS,  SIGFPE,  SIGILL, SIGTSTP};

/// State for the handler: there is only one terminal.
struct Shared {
  void (*give_back)() = nullptr;
  FirstRequest first = FirstRequest::gives_back;
  std::size_t count = 0;                 ///< number of kSignals that are handled
  volatile std::sig_atomic_t ended = 0;  ///< a signal has requested the end
  std::array<struct sigaction, kSignals.size()> actions{};
};
Shared shared;

bool has_handler(const struct sigaction& action) {
  return action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN &&
         (action.sa_flags & SA_SIGINFO) == 0;
}

extern "C" void give_back_and_go_on(int signal) {
  const auto place = std::find(kSignals.begin(), kSignals.end(), signal) - kSignals.begin();
  const struct sigaction& action = shared.actions[static_cast<std::size_t>(place)];
  const bool is_first = has_handler(action) && shared.ended == 0;
  if (!is_first || shared.first == FirstRequest::gives_back) shared.give_back();
  if (signal == SIGTSTP) {
    (void)raise(SIGSTOP);
    return;
  }
  if (is_first) {
    shared.ended = 1;
    action.sa_handler(signal);
    return;
  }
  if (action.sa_handler == SIG_IGN) return;
  // The program's own handler has already run.
  if (has_handler(action))
    (void)std::signal(signal, SIG_DFL);
  else
    sigaction(signal, &action, nullptr);
  (void)raise(signal);  // takes effect when this handler returns
}

}  // namespace

bool in_foreground(int descriptor) {
  const pid_t group = tcgetpgrp(descriptor);
  return group < 0 || group == getpgrp();
}

SignalGuard::SignalGuard(void (*give_back)(), FirstRequest first, bool takes_stop) {
  assert(shared.give_back == nullptr);
  shared.give_back = give_back;
  shared.first = first;
  shared.ended = 0;
  shared.count = kSignals.size() - (takes_stop ? 0 : 1);
  struct sigaction action {};
  action.sa_handler = give_back_and_go_on;
  for (std::size_t i = 0; i < shared.count; ++i)
    sigaction(kSignals[i], &action, &shared.actions[i]);
}

SignalGuard::~SignalGuard() {
  for (std::size_t i = 0; i < shared.count; ++i)
    sigaction(kSignals[i], &shared.actions[i], nullptr);
  shared.give_back = nullptr;
}

bool SignalGuard::has_ended() noexcept { return shared.ended != 0; }

void SignalGuard::undisturbed(void (*act)()) {
  sigset_t signals;
  sigset_t before;
  sigemptyset(&signals);
  for (const int signal : kSignals) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, &before);
  act();
  sigprocmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace reckon::tools

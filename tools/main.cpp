// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program `reckon`: hands its arguments and streams to the verbs.
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "reckon/tools/program.hpp"

namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void request_stop(int) { stop_requested.store(true, std::memory_order_relaxed); }

/// Ctrl-C, SIGTERM and a terminal that closes end a verb in good order, a second one at once; a
/// reader that went away shows as a write error.
void take_signals() {
  struct sigaction action = {};
  action.sa_handler = request_stop;
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hang_up = {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);  // under nohup it stays so
  std::signal(SIGPIPE, SIG_IGN);
}

bool takes_colour() {
  const char* no_colour = std::getenv("NO_COLOR");
  return (no_colour == nullptr || *no_colour == '\0') && isatty(STDOUT_FILENO) == 1;
}

}  // namespace

int main(int argc, char** argv) {
  take_signals();
  reckon::tools::Console console;
  console.colour = takes_colour();
  console.stop = &stop_requested;
  const std::vector<std::string_view> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  return reckon::tools::run_program(arguments, console);
}

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/stop_control.hpp"

#include <fmt/format.h>

#include <atomic>
#include <string_view>

namespace reckon::tools {
namespace {

using haptics::StopCause;

// For the signal handler, which may only read and change it.
std::atomic<haptics::ForceStop*> handled{nullptr};
static_assert(std::atomic<haptics::ForceStop*>::is_always_lock_free);

extern "C" void toggle_force_stop(int) {
  if (haptics::ForceStop* stop = handled.load()) stop->toggle(StopCause::signal);
}

std::string_view name_of(StopCause cause) {
  switch (cause) {
    case StopCause::signal:
      return "SIGUSR1";
    case StopCause::key:
      return "the key s";
    case StopCause::button:
      return "a button";
    case StopCause::program:
    case StopCause::none:
      break;
  }
  return "the program";
}

}  // namespace

StopControl::StopControl() {
  handled.store(&stop_);
  struct sigaction action {};
  action.sa_handler = toggle_force_stop;
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, &before_);
}

StopControl::~StopControl() {
  handled.store(nullptr);
  // The handler remains if the default action would end the program while it resigns.
  const bool ends = (before_.sa_flags & SA_SIGINFO) == 0 && before_.sa_handler == SIG_DFL;
  if (!ends) sigaction(SIGUSR1, &before_, nullptr);
}

void StopControl::press_key(std::chrono::nanoseconds now) noexcept {
  if (!stop_.is_pressed()) {
    stop_.press(StopCause::key);
    pressed_at_ = now;
  } else if (now - pressed_at_ >= kLeastHeld) {
    stop_.release(StopCause::key);
  }
}

std::vector<std::string> StopControl::take_notices() {
  const std::uint32_t changes = stop_.changes();
  const haptics::ForceStop::State state = stop_.state();
  if (changes == told_) return {};
  told_ = changes;
  if (!state.pressed)
    return {fmt::format("forces are restored: {} released the stop", name_of(state.cause))};
  return {
      fmt::format("all forces are stopped by {}: SIGUSR1, the key s or the button restores them",
                  name_of(state.cause))};
}

}  // namespace reckon::tools

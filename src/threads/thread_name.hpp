// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of threads for `ps -L`, `top -H` and debuggers. They show which loop of which peer uses a
// core.
#pragma once

#include <pthread.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace reckon::peer {

/// Longest name that the system keeps.
inline constexpr std::size_t kLongestThreadName = 15;

/// Names a running thread and truncates a name that is too long. Failure is ignored, because
/// nothing depends on the name.
///
///   std::thread thread(loop);
///   name_thread(thread.native_handle(), "rk-servo 1");
inline void name_thread(pthread_t thread, std::string_view name) noexcept {
  std::array<char, kLongestThreadName + 1> text{};
  std::copy_n(name.begin(), std::min(name.size(), kLongestThreadName), text.begin());
  static_cast<void>(pthread_setname_np(thread, text.data()));
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Names of threads, as `ps -L`, `top -H` and debuggers show them: by them one sees which loop of
// which peer takes a core.
#pragma once

#include <pthread.h>

#include <cstddef>
#include <string_view>

namespace reckon::peer {

/// The system keeps so many characters.
inline constexpr std::size_t kLongestThreadName = 15;

/// Names a thread that runs; what is too long is cut. A name that the system does not take is none:
/// nothing depends on it.
///
///   std::thread thread(loop);
///   name_thread(thread.native_handle(), "rk-servo 1");
void name_thread(pthread_t thread, std::string_view name) noexcept;

}  // namespace reckon::peer

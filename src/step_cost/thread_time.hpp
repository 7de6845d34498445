// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// CPU time of a thread, by which costs are measured: other programs on the host do not count.
#pragma once

#include <time.h>

namespace reckon::peer {

/// CPU time of the calling thread so far [s]; some 0.3 us.
[[nodiscard]] inline double thread_seconds() noexcept {
  timespec spent{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &spent);
  return static_cast<double>(spent.tv_sec) + 1e-9 * static_cast<double>(spent.tv_nsec);
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// CPU time used so far, by which costs are judged: other programs on the machine do not count.
#pragma once

#include <time.h>

#include <chrono>

namespace reckon::peer {

/// CPU time of one of the kernel's CPU clocks.
[[nodiscard]] inline std::chrono::nanoseconds cpu_time(clockid_t clock) noexcept {
  timespec spent{};
  clock_gettime(clock, &spent);
  return std::chrono::seconds(spent.tv_sec) + std::chrono::nanoseconds(spent.tv_nsec);
}

/// CPU time of the calling thread. Any thread; a system call, some 0.3 us.
[[nodiscard]] inline std::chrono::nanoseconds thread_cpu_time() noexcept {
  return cpu_time(CLOCK_THREAD_CPUTIME_ID);
}

/// CPU time of all threads of this process. Any thread; a system call, some 0.3 us.
[[nodiscard]] inline std::chrono::nanoseconds process_cpu_time() noexcept {
  return cpu_time(CLOCK_PROCESS_CPUTIME_ID);
}

}  // namespace reckon::peer

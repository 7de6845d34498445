// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/wake_signal.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t));

// std::atomic::wait of libstdc++ spins and yields the processor some twenty times before it sleeps.
void futex(std::atomic<std::uint32_t>& word, int operation, std::uint32_t value,
           const timespec* timeout) noexcept {
  syscall(SYS_futex, &word, operation | FUTEX_PRIVATE_FLAG, value, timeout, nullptr, 0);
}

}  // namespace

void WakeSignal::wake_sleeper() noexcept { futex(state_, FUTEX_WAKE, 1, nullptr); }

bool WakeSignal::wait(nanoseconds timeout) noexcept {
  std::uint32_t expected = kIdle;
  if (timeout > nanoseconds(0) &&
      state_.compare_exchange_strong(expected, kSleeping, std::memory_order_acq_rel)) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
    const timespec limit{seconds.count(), (timeout - seconds).count()};
    futex(state_, FUTEX_WAIT, kSleeping, timeout == nanoseconds::max() ? nullptr : &limit);
  }
  return state_.exchange(kIdle, std::memory_order_acq_rel) == kNotified;
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the host's processors awake while a late wake-up could be felt. A processor in deep sleep,
// or one returned to the hypervisor, wakes a thread of any priority late.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::peer {

/// A latency request of Linux (PM QoS), which ends with the object or the process. While it is
/// active, idle processors poll, which costs power but no other thread's time. One thread, no
/// allocation.
class AwakeProcessors {
 public:
  static constexpr const char* kRequests = "/dev/cpu_dma_latency";
  /// The request remains for this time after the last need.
  static constexpr std::chrono::nanoseconds kHold = std::chrono::seconds(1);

  /// @param requests the file for requests; if it cannot be opened nothing is kept awake
  explicit AwakeProcessors(const char* requests = kRequests) noexcept;
  ~AwakeProcessors();
  AwakeProcessors(const AwakeProcessors&) = delete;
  AwakeProcessors& operator=(const AwakeProcessors&) = delete;

  /// Whether this process may make requests.
  [[nodiscard]] static bool is_allowed() noexcept;

  /// Sets whether it is needed now. A system call on changes.
  void keep(bool needed, std::chrono::nanoseconds now) noexcept;

 private:
  void request(std::int32_t microseconds) noexcept;

  int requests_;  // below 0: none
  std::chrono::nanoseconds needed_until_{0};
  bool kept_ = false;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/awake_processors.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace reckon::peer {
namespace {

// [us], see Documentation/power/pm_qos_interface.rst of Linux: no latency, and the default.
constexpr std::int32_t kAwake = 0, kAnyLatency = 2'000'000'000;

}  // namespace

AwakeProcessors::AwakeProcessors(const char* requests) noexcept
    : requests_(open(requests, O_WRONLY | O_CLOEXEC)) {}

AwakeProcessors::~AwakeProcessors() {
  if (requests_ >= 0) close(requests_);
}

bool AwakeProcessors::is_allowed() noexcept { return access(kRequests, W_OK) == 0; }

void AwakeProcessors::keep(bool needed, std::chrono::nanoseconds now) noexcept {
  if (needed) needed_until_ = now + kHold;
  const bool wanted = now < needed_until_;
  if (wanted == kept_) return;
  kept_ = wanted;
  request(wanted ? kAwake : kAnyLatency);
}

void AwakeProcessors::request(std::int32_t microseconds) noexcept {
  if (requests_ < 0) return;
  if (write(requests_, &microseconds, sizeof microseconds) < 0) {
    close(requests_);  // this kernel accepts none
    requests_ = -1;
  }
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/clocks/steady_utc.hpp"

#include <algorithm>

namespace reckon::peer {

using std::chrono::nanoseconds;

nanoseconds SteadyUtc::at(nanoseconds now, nanoseconds host_utc) noexcept {
  const nanoseconds host_offset = host_utc - now;
  if (!started_) {
    started_ = true;
    last_ = now;
    offset_ = followed_ = host_offset;
  }
  follow(host_offset, now);
  const nanoseconds elapsed = std::max(now - last_, nanoseconds(0));
  const nanoseconds most = elapsed / (1'000'000 / kSlewPpm);
  offset_ += std::clamp(followed_ - offset_, -most, most);
  last_ += elapsed;
  return now + offset_;
}

bool SteadyUtc::is_aligned() const noexcept {
  return std::chrono::abs(followed_ - offset_) <= kStep;
}

void SteadyUtc::follow(nanoseconds host_offset, nanoseconds now) noexcept {
  leap_.reset();
  if (std::chrono::abs(host_offset - followed_) <= kStep) {
    followed_ = host_offset;
    suspect_since_.reset();
  } else if (!suspect_since_ || std::chrono::abs(host_offset - suspect_) > kStep) {
    suspect_ = host_offset;
    suspect_since_ = now;
  } else if (now - *suspect_since_ >= kHold) {
    leap_ = host_offset - followed_;
    followed_ = host_offset;
    suspect_since_.reset();
  }
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "tools/replay_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::tools {

using std::chrono::nanoseconds;

nanoseconds ReplaySchedule::due(nanoseconds time) {
  if (count_++ == 0) first_ = latest_ = time;
  latest_ = std::max(latest_, time);
  const nanoseconds at = lap_begin_ + (time - first_);
  played_ = std::max(played_, at);
  if (rate_ <= 0) return start_;
  return start_ + nanoseconds(std::llround(static_cast<double>(at.count()) / rate_));
}

void ReplaySchedule::next_lap() {
  const nanoseconds length = latest_ - first_;
  // A lap of one datagram has no spacing of its own: one a second.
  const auto gaps = static_cast<std::int64_t>(count_) - 1;
  lap_begin_ += length + (gaps > 0 ? length / gaps : nanoseconds(std::chrono::seconds(1)));
  count_ = 0;
}

}  // namespace reckon::tools

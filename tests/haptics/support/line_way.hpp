// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The way of octets over a serial line.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

namespace reckon::test {

/// One direction of a line: each octet takes its time, and arrives later by the latency.
class LineWay {
 public:
  std::chrono::nanoseconds latency{100'000};
  std::chrono::nanoseconds octet{10'000};  // 1 Mbaud

  void send(std::span<const std::uint8_t> octets, std::chrono::nanoseconds now) {
    for (const std::uint8_t one : octets) {
      free_at_ = std::max(free_at_, now) + octet;
      under_way_.emplace_back(free_at_ + latency, one);
    }
  }
  [[nodiscard]] bool is_sending(std::chrono::nanoseconds now) const { return free_at_ > now; }
  [[nodiscard]] std::vector<std::uint8_t> take(std::chrono::nanoseconds now) {
    std::vector<std::uint8_t> octets;
    for (; !under_way_.empty() && under_way_.front().first <= now; under_way_.pop_front())
      octets.push_back(under_way_.front().second);
    return octets;
  }

 private:
  std::deque<std::pair<std::chrono::nanoseconds, std::uint8_t>> under_way_;
  std::chrono::nanoseconds free_at_{0};
};

}  // namespace reckon::test

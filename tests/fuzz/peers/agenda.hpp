// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What is going to happen in a trial, by time; what is planned first happens first of one instant.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <vector>

namespace reckon::fuzz {

enum class What : std::uint8_t {
  start,
  kill,
  wake,
  arrive,
  fault,
  fault_end,
  forge,
  look,
  look_at_cut
};

struct Event {
  std::chrono::nanoseconds at;
  std::uint64_t order;
  What what;
  std::uint32_t which;  ///< host, life or fault
  std::uint32_t datagram;
  bool operator>(const Event& other) const {
    return std::tie(at, order) > std::tie(other.at, other.order);
  }
};

class Agenda {
 public:
  void add(std::chrono::nanoseconds when, What what, std::size_t which, std::size_t datagram) {
    queue_.push({when, order_++, what, static_cast<std::uint32_t>(which),
                 static_cast<std::uint32_t>(datagram)});
  }
  [[nodiscard]] bool has_until(std::chrono::nanoseconds end) const {
    return !queue_.empty() && queue_.top().at <= end;
  }
  /// The next event, which then is none any more; wants one to be there.
  Event take() {
    const Event event = queue_.top();
    queue_.pop();
    return event;
  }

 private:
  std::priority_queue<Event, std::vector<Event>, std::greater<>> queue_;
  std::uint64_t order_ = 0;
};

}  // namespace reckon::fuzz

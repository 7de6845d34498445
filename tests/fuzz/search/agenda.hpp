// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The future events of a simulated run, by time; of one instant, in the order of planning.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace reckon::fuzz {

template <typename Event>
class Agenda {
 public:
  struct Entry {
    std::chrono::nanoseconds at{};
    std::uint64_t order = 0;
    Event event;
  };

  void add(std::chrono::nanoseconds at, Event event) { put_back({at, order_++, std::move(event)}); }
  /// Puts a taken entry back; it keeps its order.
  void put_back(Entry entry) {
    entries_.push_back(std::move(entry));
    std::push_heap(entries_.begin(), entries_.end(), is_later);
  }
  [[nodiscard]] bool is_empty() const noexcept { return entries_.empty(); }
  /// The time of the next event; nanoseconds::max() without one.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept {
    return is_empty() ? std::chrono::nanoseconds::max() : entries_.front().at;
  }
  /// Removes the next event. There must be one.
  Entry take() {
    std::pop_heap(entries_.begin(), entries_.end(), is_later);
    Entry entry = std::move(entries_.back());
    entries_.pop_back();
    return entry;
  }

 private:
  static bool is_later(const Entry& one, const Entry& other) noexcept {
    return std::tie(one.at, one.order) > std::tie(other.at, other.order);
  }

  std::vector<Entry> entries_;  // a heap
  std::uint64_t order_ = 0;
};

}  // namespace reckon::fuzz

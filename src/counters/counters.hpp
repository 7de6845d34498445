// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Counters of a running peer: named numbers that any thread may read while one thread adds.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace reckon::peer {

/// One count. add() by any thread (meant for one), value() by any; relaxed, about 1 ns, never
/// waits.
class Counter {
 public:
  void add(std::uint64_t amount = 1) noexcept {
    value_.fetch_add(amount, std::memory_order_relaxed);
  }
  void set(std::uint64_t value) noexcept { value_.store(value, std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t value() const noexcept {
    return value_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint64_t> value_{0};
};

/// The counters of one peer by name. Names are made at set-up (allocates); the counters never move,
/// so a loop keeps a reference. Making names while another thread lists them is not safe.
class Counters {
 public:
  /// The counter `name`, made by the first call. `meaning` is one sentence for a reader.
  [[nodiscard]] Counter& make(std::string_view name, std::string_view meaning);
  /// The counter `name`, or null if it was not made.
  [[nodiscard]] const Counter* find(std::string_view name) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }

  /// Calls visit(name, meaning, value) for each counter, in the order of their making.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (const Entry& entry : entries_) {
      visit(std::string_view(entry.name), std::string_view(entry.meaning), entry.counter.value());
    }
  }

 private:
  struct Entry {
    std::string name;
    std::string meaning;
    Counter counter;
  };
  std::deque<Entry> entries_;
};

}  // namespace reckon::peer

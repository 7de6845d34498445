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

/// Counters that are shares of one number, distinguished by a property.
struct CounterGroup {
  std::string_view name;     ///< of the number
  std::string_view label;    ///< name of the property that distinguishes its counters
  std::string_view meaning;  ///< one sentence
};

/// Arrived datagrams that were not taken. A datagram counts in one of these counters.
inline constexpr CounterGroup kRefusedDatagrams{"datagrams_refused", "cause",
                                                "datagrams that arrived and were not accepted"};
/// Shares of `updates_out`.
inline constexpr CounterGroup kUpdatesByReason{"updates_sent_by_reason", "reason",
                                               "own updates sent, by reason"};
inline constexpr CounterGroup kUpdatesByTier{"updates_sent_by_tier", "tier",
                                             "own updates sent, by recipient tier"};

/// One counter as a reader sees it. The texts live as long as the counters.
struct CounterReading {
  std::string_view name, meaning;
  std::uint64_t value = 0;
  bool is_level = false;                ///< may fall: a present number, not a total
  const CounterGroup* group = nullptr;  ///< null: none
  std::string_view member;              ///< within its group
};

/// The counters of one peer by name. Names are made at set-up (allocates); the counters never move,
/// so a loop keeps a reference. Making names while another thread lists them is not safe.
class Counters {
 public:
  /// The counter `name`, made by the first call. `meaning` is one sentence for a reader.
  [[nodiscard]] Counter& make(std::string_view name, std::string_view meaning);
  /// The same for a number that may fall. If several callers make one counter, one such call is
  /// enough.
  [[nodiscard]] Counter& make_level(std::string_view name, std::string_view meaning);
  /// The same of a share of `group`, which outlives the counters. @param member of the group
  [[nodiscard]] Counter& make_in(const CounterGroup& group, std::string_view member,
                                 std::string_view name, std::string_view meaning);
  /// The counter `name`, or null if it was not made.
  [[nodiscard]] const Counter* find(std::string_view name) const noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }

  /// Calls visit(CounterReading) for each counter, in the order of their making.
  void for_each(auto&& visit) const {
    for (const Entry& entry : entries_) {
      visit(CounterReading{entry.name, entry.meaning, entry.counter.value(), entry.is_level,
                           entry.group, entry.member});
    }
  }

 private:
  struct Entry {
    std::string name;
    std::string meaning;
    Counter counter;
    bool is_level = false;
    const CounterGroup* group = nullptr;
    std::string member;
  };

  [[nodiscard]] Entry& entry_of(std::string_view name, std::string_view meaning);

  std::deque<Entry> entries_;
};

}  // namespace reckon::peer

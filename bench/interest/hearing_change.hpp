// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of IncrementalInterest: pairs that begin or cease to receive each other; and their sort.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reckon::bench {

/// `observer` receives `entity` from now on if `heard`, else no longer.
struct HearingChange {
  std::uint32_t observer = 0, entity = 0;
  bool heard = false;

  bool operator==(const HearingChange&) const = default;
};

/// Changes of one tick: appended in any order, read by observer and then entity. One thread.
/// Memory: 28 octets a change, for as many as the busiest recent tick had.
class HearingChanges {
 public:
  /// @param names upper limit of observers and entities, at most 2^31.
  explicit HearingChanges(std::size_t names);

  /// Removes the changes of the last tick, and releases memory of which little was used.
  void clear();
  /// Room for up to `most` further keys; commit() keeps `used` of them.
  [[nodiscard]] std::uint64_t* room(std::size_t most) {
    if (count_ + most > keys_.size()) keys_.resize(count_ + count_ / 2 + most);
    return keys_.data() + count_;
  }
  void commit(const std::uint64_t* end) noexcept {
    count_ = static_cast<std::size_t>(end - keys_.data());
  }
  void put(const HearingChange& change) {
    *room(1) = key(change.observer, change.entity, change.heard);
    ++count_;
  }
  [[nodiscard]] static std::uint64_t key(std::uint32_t observer, std::uint32_t entity,
                                         bool heard) noexcept {
    return std::uint64_t{observer} << 32 | std::uint64_t{entity} << 1 |
           static_cast<std::uint64_t>(heard);
  }

  /// All changes, sorted; valid until clear().
  [[nodiscard]] std::span<const HearingChange> sorted();
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  // Calls put(place, key) for each key, sorted by `width` bits from `shift` on; the sort is stable.
  template <typename Put>
  void sort_by_digit(unsigned shift, unsigned width, Put&& put);

  unsigned bits_;  // bits of an observer
  std::size_t count_ = 0;
  int small_ticks_ = 0;  // consecutive ticks that needed little of the capacity
  std::vector<std::uint64_t> keys_, spare_;
  std::vector<std::uint32_t> starts_;
  std::vector<HearingChange> changes_;
};

}  // namespace reckon::bench

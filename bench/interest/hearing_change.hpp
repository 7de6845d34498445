// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What IncrementalInterest tells: who hears whom from now on, or no longer; and how that is sorted.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reckon::bench {

/// `observer` hears `entity` from now on, or no longer.
struct HearingChange {
  std::uint32_t observer = 0, entity = 0;
  bool heard = false;

  bool operator==(const HearingChange&) const = default;
};

/// Changes of one tick: put in any order, read by observer and then entity. One thread. Memory: 28
/// octets a change, as many as the busiest tick of late had.
class HearingChanges {
 public:
  /// @param names observers and entities are below it, and it is at most 2^31.
  explicit HearingChanges(std::size_t names);

  /// Forgets the last tick, and gives back room that it was far from using.
  void clear();
  /// Where up to `most` further keys may be written; `used` of them are kept by commit().
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

  /// All of them, sorted; good until clear().
  [[nodiscard]] std::span<const HearingChange> sorted();
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  // put(place, key) of each, sorted by `width` bits from `shift` on, equal ones in their order.
  template <typename Put>
  void sort_by_digit(unsigned shift, unsigned width, Put&& put);

  unsigned bits_;  // of an observer
  std::size_t count_ = 0;
  int small_ticks_ = 0;  // in a row, that needed little of the room
  std::vector<std::uint64_t> keys_, spare_;
  std::vector<std::uint32_t> starts_;
  std::vector<HearingChange> changes_;
};

}  // namespace reckon::bench

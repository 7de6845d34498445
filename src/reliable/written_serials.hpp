// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which writes of one writer are known, and which exist.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::peer {

/// A set of serials from 1 on: all up to known(), and a few ranges behind.
class WrittenSerials {
 public:
  /// Ranges behind known(); a further one is forgotten, and requested again.
  static constexpr std::size_t kMostRanges = 16;

  /// The first and the last serial of a range.
  struct Range {
    std::uint32_t first = 0, last = 0;
  };

  [[nodiscard]] std::uint32_t known() const noexcept { return known_; }
  /// The last serial of the set.
  [[nodiscard]] std::uint32_t last() const noexcept {
    return count_ > 0 ? ranges_[count_ - 1].last : known_;
  }
  /// The highest serial that is said to exist.
  [[nodiscard]] std::uint32_t highest() const noexcept { return highest_; }
  [[nodiscard]] bool has_all() const noexcept { return known_ == highest_; }
  [[nodiscard]] bool has(std::uint32_t serial) const noexcept {
    if (serial <= known_) return true;
    return std::any_of(ranges_.begin(), ranges_.begin() + count_, [=](const Range& range) {
      return serial >= range.first && serial <= range.last;
    });
  }
  /// The serial before the known ones that end at `serial`; the one before it if none do.
  [[nodiscard]] std::uint32_t before(std::uint32_t serial) const noexcept {
    for (std::size_t i = 0; i < count_; ++i)
      if (serial >= ranges_[i].first && serial <= ranges_[i].last) return ranges_[i].first - 1;
    return serial <= known_ ? 0 : serial - 1;
  }
  void note_exists(std::uint32_t serial) noexcept { highest_ = std::max(highest_, serial); }
  /// Gives up what is missing.
  void forget_missing() noexcept {
    highest_ = known_ = last();
    count_ = 0;
  }

  /// Adds the serials first .. last.
  void add(std::uint32_t first, std::uint32_t last) noexcept {
    note_exists(last);
    if (first > known_ + 1) return add_range({first, last});
    known_ = std::max(known_, last);
    while (count_ > 0 && ranges_[0].first <= known_ + 1) {
      known_ = std::max(known_, ranges_[0].last);
      std::copy(ranges_.begin() + 1, ranges_.begin() + count_--, ranges_.begin());
    }
  }

  /// Calls visit(range) for each missing range, in their order.
  void for_each_missing(auto&& visit) const noexcept {
    std::uint32_t begin = known_ + 1;
    for (std::size_t i = 0; i < count_; ++i) {
      if (ranges_[i].first > begin) visit(Range{begin, ranges_[i].first - 1});
      begin = ranges_[i].last + 1;
    }
    if (begin <= highest_) visit(Range{begin, highest_});
  }

 private:
  // Ordered, without contact.
  void add_range(Range added) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Range& other = ranges_[i];
      if (other.last + 1 < added.first || added.last + 1 < other.first) {
        ranges_[kept++] = other;
      } else {
        added = {std::min(added.first, other.first), std::max(added.last, other.last)};
      }
    }
    count_ = kept;
    if (count_ == kMostRanges) return;
    auto* const place = std::find_if(ranges_.begin(), ranges_.begin() + count_,
                                     [&](const Range& one) { return one.first > added.first; });
    std::copy_backward(place, ranges_.begin() + count_, ranges_.begin() + count_ + 1);
    *place = added;
    ++count_;
  }

  std::uint32_t known_ = 0, highest_ = 0;
  std::array<Range, kMostRanges> ranges_{};
  std::size_t count_ = 0;
};

}  // namespace reckon::peer

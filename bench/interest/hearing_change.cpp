// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/hearing_change.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace reckon::bench {
namespace {

constexpr unsigned kDigitBits = 11;  // as many runs as a first-level cache has lines
constexpr std::size_t kFew = 64;     // up to this number a comparison sort is used
constexpr std::size_t kKept = std::size_t{1} << 14;  // capacity that is never released
constexpr int kSmallTicks = 16;

}  // namespace

HearingChanges::HearingChanges(std::size_t names)
    : bits_(std::max(1U, static_cast<unsigned>(std::bit_width(names)))) {
  starts_.resize(std::size_t{1} << kDigitBits);
}

void HearingChanges::clear() {
  // The tick at which all entities arrive has all pairs, fifty times as many as other ticks.
  const std::size_t enough = std::max(kKept, 2 * count_);
  small_ticks_ = keys_.size() > 8 * enough ? small_ticks_ + 1 : 0;
  if (small_ticks_ == kSmallTicks) {
    keys_ = std::vector<std::uint64_t>(enough);
    spare_ = std::vector<std::uint64_t>();
    changes_ = std::vector<HearingChange>();
  }
  count_ = 0;
}

// Radix sort from the lowest digit, first by entity and then by observer. A comparison sort would
// cost more than all comparisons of pairs before it.
std::span<const HearingChange> HearingChanges::sorted() {
  const auto change_of = [](std::uint64_t key) {
    return HearingChange{static_cast<std::uint32_t>(key >> 32),
                         static_cast<std::uint32_t>(key) >> 1, (key & 1U) != 0};
  };
  if (changes_.size() < count_) changes_.resize(keys_.size());
  if (count_ <= kFew) {
    std::sort(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(count_));
    std::transform(keys_.begin(), keys_.begin() + static_cast<std::ptrdiff_t>(count_),
                   changes_.begin(), change_of);
    return {changes_.data(), count_};
  }
  if (spare_.size() < keys_.size()) spare_.resize(keys_.size());
  const unsigned passes = (bits_ + kDigitBits - 1) / kDigitBits;
  const unsigned width = (bits_ + passes - 1) / passes;
  for (const unsigned from : {1U, 32U}) {
    for (unsigned pass = 0; pass < passes; ++pass) {
      const unsigned shift = from + pass * width;
      if (from == 32 && pass + 1 == passes) {
        sort_by_digit(shift, width,
                      [&](std::uint32_t to, std::uint64_t key) { changes_[to] = change_of(key); });
      } else {
        sort_by_digit(shift, width, [&](std::uint32_t to, std::uint64_t key) { spare_[to] = key; });
        keys_.swap(spare_);
      }
    }
  }
  return {changes_.data(), count_};
}

template <typename Put>
void HearingChanges::sort_by_digit(unsigned shift, unsigned width, Put&& put) {
  const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
  std::fill(starts_.begin(), starts_.end(), 0U);
  for (std::size_t i = 0; i < count_; ++i) ++starts_[keys_[i] >> shift & mask];
  std::exclusive_scan(starts_.begin(), starts_.end(), starts_.begin(), 0U);
  for (std::size_t i = 0; i < count_; ++i) put(starts_[keys_[i] >> shift & mask]++, keys_[i]);
}

std::size_t HearingChanges::memory() const noexcept {
  return sizeof(std::uint64_t) * (keys_.capacity() + spare_.capacity()) +
         sizeof(std::uint32_t) * starts_.capacity() + sizeof(HearingChange) * changes_.capacity();
}

}  // namespace reckon::bench

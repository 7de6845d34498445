// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/counted_truth.hpp"

#include <algorithm>
#include <cstdlib>

namespace reckon::fuzz {

using aoim::SequenceVerdict;

namespace {

constexpr std::int64_t kWindow = aoim::SequenceTracker::kWindow;
constexpr std::int64_t kFarthest = aoim::SequenceTracker::kFarthest;

}  // namespace

// A number may arrive later by up to a window.
void CountedTruth::begin(Heard& heard, std::uint32_t sequence) {
  heard.numbers.clear();
  heard.origin = sequence - std::min<std::uint32_t>(sequence, kWindow);
  heard.lowest = heard.highest = sequence;
  heard.distinct = 0;
  take(heard, sequence);
}

void CountedTruth::take(Heard& heard, std::uint32_t sequence) {
  const std::size_t place = sequence - heard.origin;
  if (place >= heard.numbers.size()) heard.numbers.resize(place + 64);
  heard.numbers[place] = true;
  ++heard.distinct;
  heard.lowest = std::min(heard.lowest, sequence);
  heard.highest = std::max(heard.highest, sequence);
}

SequenceVerdict CountedTruth::note(std::uint32_t epoch, aoim::GroupIndex group,
                                   std::uint32_t sequence) {
  Heard& heard = heard_[{epoch, group}];
  ++counts_.received;
  if (heard.distinct == 0) {
    begin(heard, sequence);
    return SequenceVerdict::first;
  }
  const std::int64_t ahead = std::int64_t{sequence} - heard.highest;
  if (ahead > kWindow || ahead < -kFarthest) return take_far(heard, sequence);
  if (ahead <= -kWindow) {
    ++counts_.too_old;
    return SequenceVerdict::too_old;
  }
  const std::size_t place = sequence - heard.origin;
  if (place < heard.numbers.size() && heard.numbers[place]) {
    ++counts_.duplicated;
    return SequenceVerdict::duplicate;
  }
  take(heard, sequence);
  // The held number is no longer far.
  if (heard.held && *heard.held - std::int64_t{heard.highest} <= kWindow &&
      *heard.held > heard.highest) {
    take(heard, *heard.held);
    heard.held.reset();
  }
  if (ahead > 0) return SequenceVerdict::in_order;
  ++counts_.reordered;
  return SequenceVerdict::late;
}

SequenceVerdict CountedTruth::take_far(Heard& heard, std::uint32_t sequence) {
  const std::int64_t apart =
      heard.held ? std::int64_t{sequence} - *heard.held : std::int64_t{1} << 32;
  if (apart == 0) {
    ++counts_.duplicated;
    return SequenceVerdict::duplicate;
  }
  if (std::abs(apart) >= kWindow) {
    ++counts_.leaps;
    heard.held = sequence;
    if (sequence > heard.highest) return SequenceVerdict::leap;
    ++counts_.too_old;
    return SequenceVerdict::too_old;
  }
  // Two numbers agree.
  const std::uint32_t low = std::min(sequence, *heard.held), high = std::max(sequence, *heard.held);
  heard.held.reset();
  const std::int64_t gap = std::int64_t{low} - heard.highest;
  if (gap > 0 && gap <= kFarthest) {
    take(heard, low);
  } else {
    counts_.lost += missing(heard);
    begin(heard, low);
  }
  take(heard, high);
  if (apart > 0) return SequenceVerdict::in_order;
  ++counts_.reordered;
  return SequenceVerdict::late;
}

template <typename Predicate>
void CountedTruth::retire(Predicate predicate) {
  std::erase_if(heard_, [&](const auto& entry) {
    if (!predicate(entry.first)) return false;
    counts_.lost += missing(entry.second);
    return true;
  });
}

void CountedTruth::forget(std::uint32_t epoch) {
  retire([epoch](const auto& key) { return key.first == epoch; });
}

void CountedTruth::forget(aoim::GroupIndex group) {
  retire([group](const auto& key) { return key.second == group; });
}

aoim::SequenceCounts CountedTruth::counts() const {
  aoim::SequenceCounts counts = counts_;
  for (const auto& entry : heard_) counts.lost += missing(entry.second);
  return counts;
}

}  // namespace reckon::fuzz

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/counted_truth.hpp"

#include <algorithm>

namespace reckon::fuzz {

using aoim::SequenceVerdict;

SequenceVerdict CountedTruth::note(std::uint32_t epoch, aoim::GroupIndex group,
                                   std::uint32_t sequence) {
  lost_ = lost_ || sequence > kMost;
  if (lost_) return SequenceVerdict::in_order;
  Heard& heard = heard_[{epoch, group}];
  ++counts_.received;
  const bool first = heard.distinct == 0;
  if (!first && sequence + aoim::SequenceTracker::kWindow <= heard.highest) {
    ++counts_.too_old;
    return SequenceVerdict::too_old;
  }
  if (sequence >= heard.numbers.size()) heard.numbers.resize(sequence + std::size_t{64});
  if (heard.numbers[sequence]) {
    ++counts_.duplicated;
    return SequenceVerdict::duplicate;
  }
  heard.numbers[sequence] = true;
  ++heard.distinct;
  if (first) {
    heard.lowest = heard.highest = sequence;
    return SequenceVerdict::first;
  }
  const bool late = sequence < heard.highest;
  if (late) ++counts_.reordered;
  heard.lowest = std::min(heard.lowest, sequence);
  heard.highest = std::max(heard.highest, sequence);
  return late ? SequenceVerdict::late : SequenceVerdict::in_order;
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

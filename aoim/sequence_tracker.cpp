// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/sequence_tracker.hpp"

#include <algorithm>
#include <bit>

namespace reckon::aoim {
namespace {

std::size_t hash(std::uint32_t epoch, GroupIndex group) noexcept {
  const std::uint64_t bits = ((std::uint64_t{epoch} << 16) | group.value) * 0x9e3779b97f4a7c15ULL;
  return static_cast<std::size_t>(bits ^ (bits >> 32));
}

template <std::size_t n>
void shift_up(std::array<std::uint64_t, n>& words, std::uint32_t by) noexcept {
  if (by >= 64 * n) {
    words.fill(0);
    return;
  }
  const std::size_t whole = by / 64;
  const unsigned part = by % 64;
  for (std::size_t i = n; i-- > 0;) {
    std::uint64_t word = i >= whole ? words[i - whole] << part : 0;
    if (part != 0 && i > whole) word |= words[i - whole - 1] >> (64 - part);
    words[i] = word;
  }
}

}  // namespace

SequenceTracker::SequenceTracker(std::size_t capacity)
    : slots_(std::bit_ceil(2 * std::max<std::size_t>(capacity, 1))),
      rehash_(slots_.size()),
      capacity_(capacity) {}

SequenceVerdict SequenceTracker::note(std::uint32_t epoch, GroupIndex group,
                                      std::uint32_t sequence) noexcept {
  Track* track = find_or_add(epoch, group);
  if (track == nullptr) {
    ++counts_.untracked;
    return SequenceVerdict::table_full;
  }
  ++counts_.received;
  if (track->span == 0) return begin(*track, sequence);

  // Serial number arithmetic: the sequence may wrap.
  const auto ahead = static_cast<std::int32_t>(sequence - track->highest);
  return ahead > 0 ? advance(*track, static_cast<std::uint32_t>(ahead))
                   : look_back(*track, track->highest - sequence);
}

SequenceVerdict SequenceTracker::begin(Track& track, std::uint32_t sequence) noexcept {
  track.highest = sequence;
  track.seen[0] = 1;
  track.span = 1;
  return SequenceVerdict::first;
}

SequenceVerdict SequenceTracker::advance(Track& track, std::uint32_t ahead) noexcept {
  shift_up(track.seen, ahead);
  track.seen[0] |= 1;
  track.highest += ahead;
  // Beyond the window the exact span no longer matters.
  track.span = ahead >= kWindow ? std::uint32_t{kWindow}
                                : std::min<std::uint32_t>(track.span + ahead, kWindow);
  counts_.lost += ahead - 1;
  return SequenceVerdict::in_order;
}

SequenceVerdict SequenceTracker::look_back(Track& track, std::uint32_t behind) noexcept {
  if (behind >= kWindow) {
    ++counts_.too_old;
    return SequenceVerdict::too_old;
  }
  std::uint64_t& word = track.seen[behind / 64];
  const std::uint64_t bit = std::uint64_t{1} << (behind % 64);
  if ((word & bit) != 0) {
    ++counts_.duplicated;
    return SequenceVerdict::duplicate;
  }
  word |= bit;
  ++counts_.reordered;
  if (behind < track.span) {
    --counts_.lost;
  } else {
    // Older than the first we got: what lies between is missing by now.
    counts_.lost += behind - track.span;
    track.span = behind + 1;
  }
  return SequenceVerdict::late;
}

SequenceTracker::Track* SequenceTracker::find_or_add(std::uint32_t epoch,
                                                     GroupIndex group) noexcept {
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = hash(epoch, group) & mask;; i = (i + 1) & mask) {
    Track& track = slots_[i];
    if (track.used && track.epoch == epoch && track.group == group) return &track;
    if (track.used) continue;
    if (size_ >= capacity_) return nullptr;
    ++size_;
    track = Track{};
    track.epoch = epoch;
    track.group = group;
    track.used = true;
    return &track;
  }
}

template <typename Predicate>
void SequenceTracker::forget_if(Predicate predicate) noexcept {
  const bool any = std::any_of(slots_.begin(), slots_.end(),
                               [&](const Track& track) { return track.used && predicate(track); });
  if (!any) return;
  std::swap(slots_, rehash_);
  for (Track& slot : slots_) slot.used = false;
  size_ = 0;
  for (const Track& old : rehash_) {
    if (old.used && !predicate(old)) *find_or_add(old.epoch, old.group) = old;
  }
}

void SequenceTracker::forget(GroupIndex group) noexcept {
  forget_if([group](const Track& track) { return track.group == group; });
}

void SequenceTracker::forget(std::uint32_t epoch) noexcept {
  forget_if([epoch](const Track& track) { return track.epoch == epoch; });
}

}  // namespace reckon::aoim

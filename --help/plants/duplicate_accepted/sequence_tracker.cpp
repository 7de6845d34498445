// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/groups/sequence_tracker.hpp"

#include <algorithm>
#include <bit>

namespace reckon::aoim {
namespace {

constexpr auto kMostAhead = static_cast<std::int32_t>(SequenceTracker::kWindow);
constexpr auto kMostBehind = static_cast<std::int32_t>(SequenceTracker::kFarthest);

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
    : capacity_(std::max<std::size_t>(capacity, 1)), index_(std::bit_ceil(2 * capacity_), kNone) {
  tracks_.reserve(capacity_);
}

SequenceVerdict SequenceTracker::note(std::uint32_t epoch, GroupIndex group,
                                      std::uint32_t sequence) noexcept {
  Track& track = find_or_add(epoch, group);
  ++counts_.received;
  if (track.span == 0) return begin(track, sequence);

  // Serial number arithmetic: the sequence may wrap around.
  const auto ahead = static_cast<std::int32_t>(sequence - track.highest);
  if (ahead > kMostAhead || ahead < -kMostBehind) return hold_leap(track, sequence);
  if (ahead <= 0) return look_back(track, track.highest - sequence);
  const SequenceVerdict verdict = advance(track, static_cast<std::uint32_t>(ahead));
  reach_leap(track);
  return verdict;
}

// One such number may be forged; a second one close to it shows the sender's new numbering.
SequenceVerdict SequenceTracker::hold_leap(Track& track, std::uint32_t sequence) noexcept {
  const auto from_first = static_cast<std::int32_t>(sequence - track.leapt_to);
  if (track.has_leapt && from_first == 0) {
    ++counts_.duplicated;
    return SequenceVerdict::duplicate;
  }
  if (track.has_leapt && from_first > -kMostAhead && from_first < kMostAhead) {
    follow_leap(track, sequence);
    if (from_first > 0) return SequenceVerdict::in_order;
    ++counts_.reordered;
    return SequenceVerdict::late;
  }
  ++counts_.leaps;
  track.leapt_to = sequence;
  track.has_leapt = true;
  if (static_cast<std::int32_t>(sequence - track.highest) > 0) return SequenceVerdict::leap;
  ++counts_.too_old;
  return SequenceVerdict::too_old;
}

void SequenceTracker::follow_leap(Track& track, std::uint32_t sequence) noexcept {
  const bool in_order = static_cast<std::int32_t>(sequence - track.leapt_to) > 0;
  const std::uint32_t low = in_order ? track.leapt_to : sequence;
  const std::uint32_t high = in_order ? sequence : track.leapt_to;
  track.has_leapt = false;
  // The numbers up to there are lost, unless the numbering itself is new.
  const std::uint32_t gap = low - track.highest;
  if (gap <= kFarthest) {
    advance(track, gap);
  } else {
    track.seen.fill(0);
    begin(track, low);
  }
  advance(track, high - low);
}

// The number that was too far ahead is within the window by now.
void SequenceTracker::reach_leap(Track& track) noexcept {
  if (!track.has_leapt) return;
  const auto ahead = static_cast<std::int32_t>(track.leapt_to - track.highest);
  if (ahead <= 0 || ahead > kMostAhead) return;
  track.has_leapt = false;
  advance(track, static_cast<std::uint32_t>(ahead));
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
  if (false && (word & bit) != 0) {
    ++counts_.duplicated;
    return SequenceVerdict::duplicate;
  }
  word |= bit;
  ++counts_.reordered;
  if (behind < track.span) {
    --counts_.lost;
  } else {
    // Older than the first one received: the numbers in between are missing by now.
    counts_.lost += behind - track.span;
    track.span = behind + 1;
  }
  return SequenceVerdict::late;
}

SequenceTracker::Track& SequenceTracker::find_or_add(std::uint32_t epoch,
                                                     GroupIndex group) noexcept {
  std::size_t slot = slot_of(epoch, group);
  if (index_[slot] == kNone) {
    if (tracks_.size() == capacity_) {
      erase(oldest_);
      ++counts_.given_up;
      slot = slot_of(epoch, group);
    }
    index_[slot] = static_cast<std::uint32_t>(tracks_.size());
    Track& track = tracks_.emplace_back();  // within the capacity of construction
    track.epoch = epoch;
    track.group = group;
    link_newest(index_[slot]);
  } else if (index_[slot] != newest_) {
    unlink(index_[slot]);
    link_newest(index_[slot]);
  }
  return tracks_[index_[slot]];
}

std::size_t SequenceTracker::slot_of(std::uint32_t epoch, GroupIndex group) const noexcept {
  const std::size_t mask = index_.size() - 1;
  std::size_t slot = hash(epoch, group) & mask;
  for (; index_[slot] != kNone; slot = (slot + 1) & mask) {
    const Track& track = tracks_[index_[slot]];
    if (track.epoch == epoch && track.group == group) break;
  }
  return slot;
}

// The last track takes its place.
void SequenceTracker::erase(std::uint32_t place) noexcept {
  unlink(place);
  close_gap(slot_of(tracks_[place].epoch, tracks_[place].group));
  const auto last = static_cast<std::uint32_t>(tracks_.size() - 1);
  if (place != last) {
    const Track moved = tracks_[last];
    index_[slot_of(moved.epoch, moved.group)] = place;
    tracks_[place] = moved;
    (moved.newer == kNone ? newest_ : tracks_[moved.newer].older) = place;
    (moved.older == kNone ? oldest_ : tracks_[moved.older].newer) = place;
  }
  tracks_.pop_back();
}

// Moves up the entries that collided behind the gap, so that a search for them meets no gap.
void SequenceTracker::close_gap(std::size_t gap) noexcept {
  const std::size_t mask = index_.size() - 1;
  for (std::size_t i = (gap + 1) & mask; index_[i] != kNone; i = (i + 1) & mask) {
    const Track& track = tracks_[index_[i]];
    const std::size_t home = hash(track.epoch, track.group) & mask;
    if (((i - home) & mask) < ((i - gap) & mask)) continue;
    index_[gap] = index_[i];
    gap = i;
  }
  index_[gap] = kNone;
}

void SequenceTracker::link_newest(std::uint32_t place) noexcept {
  tracks_[place].newer = kNone;
  tracks_[place].older = newest_;
  (newest_ == kNone ? oldest_ : tracks_[newest_].newer) = place;
  newest_ = place;
}

void SequenceTracker::unlink(std::uint32_t place) noexcept {
  const Track& track = tracks_[place];
  (track.newer == kNone ? newest_ : tracks_[track.newer].older) = track.older;
  (track.older == kNone ? oldest_ : tracks_[track.older].newer) = track.newer;
}

void SequenceTracker::forget_if(auto predicate) noexcept {
  for (std::size_t i = tracks_.size(); i-- > 0;) {
    if (predicate(tracks_[i])) erase(static_cast<std::uint32_t>(i));
  }
}

void SequenceTracker::forget(GroupIndex group) noexcept {
  forget_if([group](const Track& track) { return track.group == group; });
}

void SequenceTracker::forget(std::uint32_t epoch) noexcept {
  forget_if([epoch](const Track& track) { return track.epoch == epoch; });
}

}  // namespace reckon::aoim

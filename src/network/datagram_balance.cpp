// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/datagram_balance.hpp"

#include <algorithm>
#include <utility>

namespace reckon::peer {
namespace {

using aoim::SequenceVerdict;
using std::chrono::nanoseconds;

// Events taken in one call, so that a flood does not keep the caller from other work.
constexpr std::size_t kMostEvents = std::size_t{1} << 17;
// Most gaps remembered of one stretch; a datagram that fills an older one counts as a copy.
constexpr std::size_t kMostGaps = 4096;
// A number farther than this from the last one begins a new stretch.
constexpr std::int32_t kFarthestNumber = 1 << 20;

// Serial number arithmetic: numbers may wrap around.
std::int32_t ahead_of(std::uint32_t number, std::uint32_t other) noexcept {
  return static_cast<std::int32_t>(number - other);
}

}  // namespace

void DatagramBalance::look() {
  DatagramEvent event;
  for (std::size_t i = 0; i < kMostEvents && tap_.pop(event); ++i) take(event);
}

void DatagramBalance::take(const DatagramEvent& event) {
  switch (event.fate) {
    case DatagramFate::joined:
      end_membership(event);
      memberships_[event.group].group = event.group;
      memberships_[event.group].joining = event.asked;
      memberships_[event.group].joined = event.time;
      return;
    case DatagramFate::left:
      return end_membership(event);
    case DatagramFate::kernel_drops:
      memberships_[event.group].group = event.group;
      memberships_[event.group].kernel_drops += event.count;
      return;
    default:
      break;
  }
  const SenderInGroup key{event.epoch, event.stream, event.group};
  FateCounts& counts = fates_[key];
  counts.key = key;
  counts.counts[static_cast<std::size_t>(event.fate)] += event.count;
  if (event.epoch == 0) return;
  if (event.fate == DatagramFate::arrived) arrive(event);
  const bool counts_on = event.verdict && aoim::is_usable(*event.verdict);
  if (counts_on) track(event);
}

void DatagramBalance::arrive(const DatagramEvent& event) {
  const SenderInGroup key{event.epoch, event.stream, event.group};
  const std::uint32_t number = event.sequence;
  auto found = open_.find(key);
  if (found != open_.end()) {
    const std::int32_t ahead = ahead_of(number, found->second.stretch.last);
    if (ahead > kFarthestNumber || ahead < -kFarthestNumber) {
      over_.stretches.push_back(found->second.stretch);
      open_.erase(found);
      found = open_.end();
    }
  }
  if (found == open_.end()) {
    const auto membership = memberships_.find(event.group);
    const bool joined = membership != memberships_.end();
    open_[key].stretch = {
        key, number, number, 1, 0, 0, joined ? membership->second.joined : nanoseconds(-1)};
    return;
  }
  OpenStretch& open = found->second;
  Stretch& stretch = open.stretch;
  open.heard = true;
  if (ahead_of(number, stretch.last) > 0) {
    if (number != stretch.last + 1) open.gaps.push_back({stretch.last + 1, number - 1});
    stretch.missing += number - stretch.last - 1;
    stretch.last = number;
    ++stretch.arrived;
  } else if (ahead_of(number, stretch.first) < 0) {
    if (number + 1 != stretch.first)
      open.gaps.insert(open.gaps.begin(), {number + 1, stretch.first - 1});
    stretch.missing += stretch.first - number - 1;
    stretch.first = number;
    ++stretch.arrived;
  } else if (fill_gap(open, number)) {
    --stretch.missing;
    ++stretch.arrived;
  } else {
    ++stretch.copies;
  }
  if (open.gaps.size() > kMostGaps) open.gaps.erase(open.gaps.begin());
}

// False if the number has arrived before.
bool DatagramBalance::fill_gap(OpenStretch& stretch, std::uint32_t number) {
  const auto gap =
      std::find_if(stretch.gaps.rbegin(), stretch.gaps.rend(), [number](const Gap& candidate) {
        return ahead_of(number, candidate.first) >= 0 && ahead_of(number, candidate.last) <= 0;
      });
  if (gap == stretch.gaps.rend()) return false;
  const Gap before{gap->first, number - 1}, behind{number + 1, gap->last};
  const bool has_before = number != gap->first, has_behind = number != gap->last;
  const auto place = std::next(gap).base();
  if (has_before && has_behind) {
    *place = behind;
    stretch.gaps.insert(place, before);
  } else if (has_before || has_behind) {
    *place = has_before ? before : behind;
  } else {
    stretch.gaps.erase(place);
  }
  return true;
}

// The verdict of the sequence tracker, besides what really arrived.
void DatagramBalance::track(const DatagramEvent& event) {
  const SenderInGroup key{event.epoch, event.stream, event.group};
  auto found = tracked_.find(key);
  if (event.verdict == SequenceVerdict::first || found == tracked_.end()) {
    if (found != tracked_.end()) over_.tracked.push_back(found->second.stretch);
    tracked_[key] = {};
    tracked_[key].stretch = {key, event.sequence, event.sequence, 1, 0};
    return;
  }
  OpenTracked& open = found->second;
  open.heard = true;
  open.stretch.lost += event.lost;
  if (event.verdict == SequenceVerdict::leap) {
    open.leapt_to = event.sequence;
    open.has_leapt = true;
    return;
  }
  // If the numbering has followed a leap, that number counts too.
  const std::uint32_t greatest =
      ahead_of(event.sequence, open.stretch.last) > 0 ? event.sequence : open.stretch.last;
  const auto window = static_cast<std::int32_t>(aoim::SequenceTracker::kWindow);
  if (open.has_leapt && ahead_of(open.leapt_to, greatest) <= window) {
    open.has_leapt = false;
    ++open.stretch.received;
    if (ahead_of(open.leapt_to, open.stretch.last) > 0) open.stretch.last = open.leapt_to;
  }
  ++open.stretch.received;
  if (ahead_of(event.sequence, open.stretch.last) > 0) open.stretch.last = event.sequence;
  if (ahead_of(event.sequence, open.stretch.first) < 0) open.stretch.first = event.sequence;
}

void DatagramBalance::end_stretches(const GroupAddress& group) {
  for (auto one = open_.begin(); one != open_.end();) {
    if (one->first.group != group) {
      ++one;
      continue;
    }
    over_.stretches.push_back(one->second.stretch);
    one = open_.erase(one);
  }
}

void DatagramBalance::end_membership(const DatagramEvent& end) {
  end_stretches(end.group);
  const auto found = memberships_.find(end.group);
  if (found == memberships_.end()) return;
  found->second.leaving = end.asked;
  found->second.left = end.time;
  over_.memberships.push_back(found->second);
  memberships_.erase(found);
}

template <class Open, class Over>
void DatagramBalance::end_silent(std::map<SenderInGroup, Open>& open, std::vector<Over>& over,
                                 nanoseconds now, bool end) {
  for (auto one = open.begin(); one != open.end();) {
    Open& what = one->second;
    if (what.heard) what.silent_since = now;
    what.heard = false;
    const bool is_over = end || now - what.silent_since >= kSilence;
    if (is_over) over.push_back(what.stretch);
    one = is_over ? open.erase(one) : std::next(one);
  }
}

BalanceReport DatagramBalance::report(nanoseconds now, bool end) {
  end_silent(open_, over_.stretches, now, end);
  end_silent(tracked_, over_.tracked, now, end);
  for (const auto& [key, counts] : std::exchange(fates_, {})) over_.fates.push_back(counts);
  if (end) {
    for (const auto& [group, membership] : std::exchange(memberships_, {}))
      over_.memberships.push_back(membership);
  }
  over_.missed = tap_.missed();
  return std::exchange(over_, {});
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When the area-of-interest manager begins to introduce our entities: at once, as long as those who
// ask have not caused too much of it lately.
#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// Who has been heard for so long is no stranger.
constexpr std::chrono::seconds kKnown{10};
// Beyond its spread an introduction may last so long, where steps are slow.
constexpr std::chrono::milliseconds kLate{100};
// How much the last entity counts in the average.
constexpr double kWeight = 1.0 / 16.0;

}  // namespace

void AreaOfInterestManager::set_owned(std::size_t count) noexcept {
  owned_ = count;
  introduction_.set_owned(count);
  const double whole = static_cast<double>(count) * introduced_octets_;
  strangers_.budget.set_whole(whole);
  members_.budget.set_whole(whole);
}

// Whoever listens now to `group` has not heard what we say there.
void AreaOfInterestManager::introduce_to(GroupIndex group, nanoseconds heard_for, nanoseconds now) {
  Introduced& those = heard_for >= kKnown ? members_ : strangers_;
  if (those.waits[group.value]) return;
  those.waits[group.value] = true;
  those.waiting.push_back(group);
  introduce_to_waiting(now);
}

void AreaOfInterestManager::introduce_to_waiting(nanoseconds now) {
  for (Introduced* those : {&strangers_, &members_}) {
    if (those->waiting.empty() || !those->budget.may_begin(now)) continue;
    for (const GroupIndex group : those->waiting) {
      introduction_.begin(group, now);
      those->waits[group.value] = false;
    }
    those->waiting.clear();
    those->until = now + introduction_.spread() + kLate;
  }
}

void AreaOfInterestManager::note_introduced(std::size_t octets, nanoseconds now) noexcept {
  introduced_octets_ += kWeight * (static_cast<double>(octets) - introduced_octets_);
  set_owned(owned_);
  for (Introduced* those : {&strangers_, &members_}) {
    if (now <= those->until) those->budget.spend(octets, now);
  }
}

}  // namespace reckon::aoim

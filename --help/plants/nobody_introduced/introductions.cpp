// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/introductions.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// A sender received for this long is no stranger.
constexpr std::chrono::seconds kKnown{10};
// Time beyond its spread for which an introduction may last if steps are slow.
constexpr std::chrono::milliseconds kLate{100};
// Weight of the last entity in the average.
constexpr double kWeight = 1.0 / 16.0;

}  // namespace

Introductions::Introductions(const IntroductionConfig& config, std::size_t groups)
    : introduction_(config) {
  for (Askers& those : askers_) {
    those.waiting.reserve(groups + 1);
    those.waits.resize(groups + 1);
  }
}

void Introductions::set_owned(std::size_t count) noexcept {
  owned_ = count;
  introduction_.set_owned(count);
  for (Askers& those : askers_) those.budget.set_whole(static_cast<double>(count) * octets_);
}

void Introductions::begin(GroupIndex group, nanoseconds heard_for, nanoseconds now) {
  Askers& those = askers_[heard_for >= kKnown ? 1 : 0];
  if (those.waits[group.value]) return;
  those.waits[group.value] = true;
  those.waiting.push_back(group);
  begin_waiting(now);
}

void Introductions::begin_waiting(nanoseconds now) {
  for (Askers& those : askers_) {
    if (those.waiting.empty() || !those.budget.may_begin(now)) continue;
    for (const GroupIndex group : those.waiting) {
      those.waits[group.value] = false;
    }
    those.waiting.clear();
    those.until = now + introduction_.spread() + kLate;
  }
}

void Introductions::step(nanoseconds now) {
  begin_waiting(now);
  introduction_.expire(now);
}

nanoseconds Introductions::next_step() const noexcept {
  nanoseconds next = nanoseconds::max();
  for (const Askers& those : askers_) {
    if (!those.waiting.empty()) next = std::min(next, those.budget.ready_at());
  }
  return next;
}

void Introductions::note_sent(std::size_t octets, nanoseconds now) noexcept {
  octets_ += kWeight * (static_cast<double>(octets) - octets_);
  set_owned(owned_);
  for (Askers& those : askers_) {
    if (now <= those.until) those.budget.spend(octets, now);
  }
}

}  // namespace reckon::aoim

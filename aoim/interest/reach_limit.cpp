// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/reach_limit.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/pdu/seconds.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr nanoseconds kStretch = 2s;
// Groups are kept for at least 2 s, and new ones start with the states of all entities there.
constexpr nanoseconds kSettle = 3s;
constexpr nanoseconds kShortestHold = 20s, kLongestHold = 160s;
constexpr double kRoom = 0.8;     // share of the budget below which more cells are let in
constexpr double kFarOver = 1.5;  // share of the budget that ends a step outwards at once
constexpr double kFilled = 0.9;   // share of the budget that a step outwards aims at
constexpr double kOutwards = 1.25;
constexpr double kMostAtOnce = 0.4, kLeastAtOnce = 0.9;

}  // namespace

void ReachLimit::note(std::uint64_t octets, nanoseconds now) noexcept {
  if (!begun_ || now < since_ || octets < from_) {
    if (!begun_ || octets < from_) since_ = std::max(since_, now);
    begun_ = true;
    from_ = octets;
    return;
  }
  if (now - since_ < kStretch) return;
  heard_ = static_cast<double>(octets - from_) / pdu::to_seconds(now - since_);
  from_ = octets;
  since_ = now;
  over_ = is_met() ? 0 : over_ + 1;
  const bool surely = closing_ || (raised_ && heard_ > kFarOver * config_.budget);
  if (over_ >= (surely ? 1 : 2)) {
    lower(now);
  } else if (over_ == 0) {
    raise(now);
  }
}

void ReachLimit::lower(nanoseconds now) noexcept {
  if (cut_ <= 0.0) return;
  if (raised_) hold_ = std::min(2 * hold_, kLongestHold);
  const double share = std::clamp(std::sqrt(config_.budget / heard_), kMostAtOnce, kLeastAtOnce);
  double cut = raised_ ? before_ : share * std::min(cut_, config_.farthest);
  if (cut < 0.1 * config_.cell) cut = 0.0;
  closing_ = true;
  raised_ = false;
  set(cut, now);
}

void ReachLimit::raise(nanoseconds now) noexcept {
  if (raised_) hold_ = kShortestHold;
  raised_ = closing_ = false;
  if (!is_cut() || heard_ > kRoom * config_.budget || now < raise_after_) return;
  before_ = cut_;
  raised_ = true;
  const double fits = std::sqrt(kFilled * config_.budget / std::max(heard_, 1.0));
  const double cut = std::max(std::min(fits, kOutwards) * cut_, cut_ + 0.25 * config_.cell);
  set(cut < config_.farthest ? cut : std::numeric_limits<double>::infinity(), now);
}

void ReachLimit::set(double cut, nanoseconds now) noexcept {
  cut_ = cut;
  over_ = 0;
  since_ = now + kSettle;
  raise_after_ = now + hold_;
}

}  // namespace reckon::aoim

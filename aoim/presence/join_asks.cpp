// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/join_asks.hpp"

#include <algorithm>

namespace reckon::aoim {

using std::chrono::nanoseconds;

JoinAsks::JoinAsks(std::size_t pool) : silent_(pool + 1) {
  joined_.reserve(pool);
  due_.reserve(pool);
}

void JoinAsks::join(GroupIndex group, CellId cell, bool ask, nanoseconds now) {
  leave(group);
  silent_[group.value] = 1;
  joined_.push_back({group, cell, now, 0, kMostRepetitions, ask});
  has_new_ = has_new_ || ask;
}

void JoinAsks::leave(GroupIndex group) noexcept {
  std::erase_if(joined_, [group](const Joined& joined) { return joined.group == group; });
}

std::span<const JoinAsks::Question> JoinAsks::take_due(nanoseconds now, std::uint64_t utc,
                                                       bool announcing) {
  due_.clear();
  std::size_t fresh = 0;
  std::uint64_t time = 0;
  const auto ask_anew = [&](Joined& joined) {
    if (fresh++ % kMostCells == 0) time = take_time(utc);
    joined.since = time;
    due_.push_back({joined.cell, joined.since});
  };
  for (Joined& joined : joined_) {
    if (joined.is_new) {
      joined.is_new = false;
      joined.at = now;
      ask_anew(joined);
    } else if (announcing && now - joined.at >= kAnswered) {
      const bool is_silent = silent_[joined.group.value] != 0;
      if (is_silent) {
        ask_anew(joined);
      } else if (joined.left == kMostRepetitions && joined.since != 0) {
        due_.push_back({joined.cell, joined.since});  // for peers that have not received it
      }
      joined.left = is_silent ? joined.left - 1 : 0;
    }
  }
  std::erase_if(joined_, [](const Joined& joined) { return joined.left == 0; });
  std::ranges::sort(due_, {}, &Question::since);
  has_new_ = false;
  return due_;
}

std::uint64_t JoinAsks::take_time(std::uint64_t utc) noexcept {
  last_time_ = std::max(utc, last_time_ + 1);
  return last_time_;
}

nanoseconds JoinAsks::next_repetition() const noexcept {
  nanoseconds next = nanoseconds::max();
  for (const Joined& joined : joined_) {
    const bool was_asked_once = joined.since != 0 && joined.left == kMostRepetitions;
    if (was_asked_once) next = std::min(next, joined.at + kSaidAgain);
  }
  return next;
}

bool ReceivedAsks::note(std::uint32_t epoch, std::uint64_t since) noexcept {
  if (since == 0) return true;
  const std::uint64_t question = since ^ std::uint64_t{epoch} << 32;
  constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u;  // Fibonacci hashing
  std::uint64_t& place = heard_[(question * kGolden >> 32) % kKept];
  const bool is_new = place != question;
  place = question;
  return is_new;
}

}  // namespace reckon::aoim

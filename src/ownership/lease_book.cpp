// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/lease_book.hpp"

#include <algorithm>

namespace reckon::peer {

using std::chrono::nanoseconds;

std::uint8_t LeaseBook::round(nanoseconds now) noexcept {
  if (rounds_ == 0 || now - sent_[(rounds_ - 1) % kRounds] >= kRound)
    sent_[rounds_++ % kRounds] = now;
  return static_cast<std::uint8_t>(1 + (rounds_ - 1) % kRounds);
}

const LeaseBook::Row* LeaseBook::find(std::uint32_t epoch) const noexcept {
  const auto used = std::span(rows_).first(used_);
  const auto found = std::ranges::find(used, epoch, &Row::epoch);
  return found == used.end() ? nullptr : &*found;
}

// The peer that has been silent for the longest makes room.
LeaseBook::Row& LeaseBook::row_of(std::uint32_t epoch) noexcept {
  if (const Row* known = find(epoch)) return const_cast<Row&>(*known);
  Row& row =
      used_ < rows_.size() ? rows_[used_++] : *std::ranges::min_element(rows_, {}, &Row::heard);
  row = {};
  row.epoch = epoch;
  return row;
}

void LeaseBook::receive(std::uint32_t epoch, std::uint8_t round, nanoseconds now) noexcept {
  if (epoch == 0 || round == 0) return;
  Row& row = row_of(epoch);
  const std::uint32_t ahead = (kRounds + round - row.round) % kRounds;
  const bool is_older = row.round != 0 && now - row.heard < kOldest && ahead > kRounds / 2;
  if (is_older) return;
  row.round = round;
  row.heard = now;
}

std::optional<nanoseconds> LeaseBook::sent_at(std::uint8_t round, nanoseconds now) const noexcept {
  if (round == 0 || rounds_ == 0) return {};
  const std::uint32_t newest = (rounds_ - 1) % kRounds, wanted = round - 1U;
  const std::uint32_t back = (kRounds + newest - wanted) % kRounds;
  if (back >= rounds_ || back > kRemembered || now - sent_[wanted] > 2 * kOldest) return {};
  return sent_[wanted];
}

void LeaseBook::confirm(std::uint32_t epoch, std::uint8_t round, nanoseconds now) noexcept {
  const std::optional<nanoseconds> sent = sent_at(round, now);
  if (epoch == 0 || !sent) return;
  Row& row = row_of(epoch);
  row.confirmed = std::max(row.confirmed, *sent);
}

std::uint8_t LeaseBook::round_of(std::uint32_t epoch, nanoseconds now) const noexcept {
  const Row* row = find(epoch);
  return row == nullptr || now - row->heard > kOldest ? std::uint8_t{0} : row->round;
}

nanoseconds LeaseBook::heard_at(std::uint32_t epoch) const noexcept {
  const Row* row = find(epoch);
  return row == nullptr ? kNever : row->heard;
}

nanoseconds LeaseBook::silent_since(std::uint32_t epoch) const noexcept {
  return std::max(heard_at(epoch), restarted_);
}

nanoseconds LeaseBook::lease_end(const Roll& roll, std::uint32_t own,
                                 nanoseconds now) const noexcept {
  std::array<nanoseconds, Roll::kMost> confirmed{};
  const auto voters = roll.voters();
  for (std::size_t i = 0; i < voters.size(); ++i) {
    const Row* row = find(voters[i].epoch);
    confirmed[i] = voters[i].epoch == own ? now : row == nullptr ? kNever : row->confirmed;
  }
  const std::size_t last = roll.last_of_majority(std::span(confirmed).first(voters.size()));
  return last == Roll::kNone ? kNever : confirmed[last] + kLease;
}

}  // namespace reckon::peer

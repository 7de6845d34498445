// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/roll.hpp"

#include <algorithm>

#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::peer {

bool Roll::add(const Voter& voter) noexcept {
  if (count_ == kMost || voter.epoch == 0 || contains(voter.epoch)) return false;
  voters_[count_++] = voter;
  return true;
}

void Roll::remove(std::uint32_t epoch) noexcept {
  const std::size_t index = index_of(epoch);
  if (index == kNone) return;
  std::copy(voters_.begin() + static_cast<std::ptrdiff_t>(index) + 1,
            voters_.begin() + static_cast<std::ptrdiff_t>(count_),
            voters_.begin() + static_cast<std::ptrdiff_t>(index));
  voters_[--count_] = {};
}

std::size_t Roll::index_of(std::uint32_t epoch) const noexcept {
  const auto all = voters();
  const auto found = std::ranges::find(all, epoch, &Voter::epoch);
  return found == all.end() ? kNone : static_cast<std::size_t>(found - all.begin());
}

double Roll::share(std::array<double, kMost>& shares) const noexcept {
  std::array<std::uint8_t, kMost> of_host{};
  double hosts = 0.0;
  for (const Voter& voter : voters()) hosts += of_host[voter.host % kMost]++ == 0 ? 1.0 : 0.0;
  for (std::size_t i = 0; i < count_; ++i) shares[i] = 1.0 / of_host[voters_[i].host % kMost];
  return hosts;
}

// Parts differ by at least 1 / 64^2; the sum of 64 of them has an error below 1e-13.
bool Roll::is_most(double votes, double all, bool with_senior) noexcept {
  constexpr double kRounding = 1e-9;
  return 2.0 * votes > all + kRounding || (with_senior && 2.0 * votes > all - kRounding);
}

bool Roll::is_majority_of(const std::array<bool, kMost>& in) const noexcept {
  std::array<double, kMost> shares;
  const double all = share(shares);
  double votes = 0.0;
  for (std::size_t i = 0; i < count_; ++i) votes += in[i] ? shares[i] : 0.0;
  return count_ > 0 && is_most(votes, all, in[0]);
}

std::size_t Roll::last_of_majority(std::span<const std::chrono::nanoseconds> times) const noexcept {
  std::array<double, kMost> shares;
  const double all = share(shares);
  std::array<std::uint8_t, kMost> order;
  for (std::size_t i = 0; i < count_; ++i) order[i] = static_cast<std::uint8_t>(i);
  const auto voters = std::span(order).first(count_);
  std::ranges::sort(voters, [&](std::uint8_t a, std::uint8_t b) { return times[a] > times[b]; });
  double votes = 0.0;
  bool with_senior = false;
  for (std::size_t i = 0; i < voters.size(); ++i) {
    votes += shares[voters[i]];
    with_senior = with_senior || voters[i] == 0;
    const bool is_tied = i + 1 < voters.size() && times[voters[i + 1]] == times[voters[i]];
    if (!is_tied && is_most(votes, all, with_senior)) return voters[i];
  }
  return kNone;
}

std::uint32_t Roll::hash() const noexcept {
  std::uint64_t hash = 0;
  for (const Voter& voter : voters())
    hash = pdu::split_mix(hash ^ (std::uint64_t{voter.epoch} << 8 | voter.host));
  return static_cast<std::uint32_t>(hash >> 32);
}

bool operator==(const Roll& a, const Roll& b) noexcept {
  return std::ranges::equal(a.voters(), b.voters());
}

}  // namespace reckon::peer

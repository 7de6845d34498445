// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/roll.hpp"

#include <algorithm>
#include <cmath>

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

bool Roll::is_majority_of(const std::array<bool, kMost>& in) const noexcept {
  std::array<std::uint8_t, kMost> of_host{}, in_host{};
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t host = voters_[i].host % kMost;
    ++of_host[host];
    if (in[i]) ++in_host[host];
  }
  double votes = 0.0, all = 0.0;
  for (std::size_t host = 0; host < of_host.size(); ++host) {
    if (of_host[host] == 0) continue;
    all += 1.0;
    votes += static_cast<double>(in_host[host]) / of_host[host];
  }
  if (all == 0.0) return false;
  // Parts differ by at least 1 / 64^2; the sum of 64 of them has an error below 1e-13.
  constexpr double kRounding = 1e-9;
  if (std::abs(2.0 * votes - all) < kRounding) return in[0];
  return 2.0 * votes > all;
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

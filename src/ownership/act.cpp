// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/act.hpp"

#include <algorithm>

#include "reckon/pdu/random/split_mix.hpp"

namespace reckon::peer {

bool Act::removes(std::uint32_t epoch) const noexcept {
  return std::ranges::find(removed(), epoch) != removed().end();
}

bool Act::remove(std::uint32_t epoch) noexcept {
  if (removed_count == removed_epochs.size()) return false;
  removed_epochs[removed_count++] = epoch;
  roll.remove(epoch);
  return true;
}

std::uint32_t Act::hash() const noexcept {
  std::uint64_t hash = pdu::split_mix(std::uint64_t{number} << 32 | chair);
  hash = pdu::split_mix(hash ^ roll.hash());
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i]) hash = pdu::split_mix(hash ^ i);
  }
  for (const std::uint32_t epoch : removed()) hash = pdu::split_mix(hash ^ epoch);
  return static_cast<std::uint32_t>(hash >> 32);
}

}  // namespace reckon::peer

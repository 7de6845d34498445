// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/listeners.hpp"

#include <algorithm>

namespace reckon::bench {

Listeners::Listeners(const ScaleSetting& setting, std::size_t near_rows, Witnesses& witnesses)
    : count_(setting.grid.pool * (1 + near_rows) + 1, 0), witnesses_(witnesses) {
  count_[0] = static_cast<std::uint32_t>(setting.peers);
}

void Listeners::join(std::uint32_t peer, aoim::GroupIndex group, double from) {
  joining_.push_back({from, group});
  const std::size_t witness = witnesses_.witness_of(peer);
  if (witness < witnesses_.size()) witnesses_.join(witness, group, from);
}

void Listeners::leave(std::uint32_t peer, aoim::GroupIndex group, std::size_t pool) {
  --count_[group.value];
  const std::size_t witness = witnesses_.witness_of(peer);
  if (witness < witnesses_.size()) witnesses_.leave(witness, group, pool);
}

void Listeners::arrive(double time) {
  std::erase_if(joining_, [&](const Pending& join) {
    if (join.from > time) return false;
    ++count_[join.group.value];
    return true;
  });
}

std::uint64_t Listeners::groups() const noexcept {
  return static_cast<std::uint64_t>(
      std::count_if(count_.begin() + 1, count_.end(), [](std::uint32_t n) { return n > 0; }));
}

}  // namespace reckon::bench

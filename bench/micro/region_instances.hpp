// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Regions as in the literature on region matching: half subscriptions, half updates; cubes of equal
// size, uniformly placed in the unit cube; alpha = number of regions x volume of a region.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "reckon/bench/interest/region.hpp"

namespace reckon::bench {

template <std::size_t D>
struct RegionInstance {
  std::vector<bench::Region<D>> subscriptions, updates;

  RegionInstance(std::size_t count, double alpha) : subscriptions(count / 2), updates(count / 2) {
    const double side = std::pow(alpha / static_cast<double>(count), 1.0 / static_cast<double>(D));
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> along(0.0, 1.0 - side);
    for (auto* regions : {&subscriptions, &updates}) {
      for (bench::Region<D>& region : *regions) {
        for (std::size_t axis = 0; axis < D; ++axis) {
          region.lower[axis] = along(random);
          region.upper[axis] = region.lower[axis] + side;
        }
      }
    }
  }
};

/// Stores pairs like a user that processes them in blocks: 32 MiB, overwritten repeatedly.
class PairRing {
 public:
  void put(const bench::RegionPair& pair) noexcept { pairs_[count_++ & (kRoom - 1)] = pair; }
  void put(std::span<const bench::RegionPair> pairs) noexcept {
    for (const bench::RegionPair& pair : pairs) put(pair);
  }
  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }

 private:
  static constexpr std::size_t kRoom = std::size_t{1} << 22;
  std::vector<bench::RegionPair> pairs_ = std::vector<bench::RegionPair>(kRoom);
  std::uint64_t count_ = 0;
};

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Overlaps of all subscription regions with all update regions at once: interest management by
// regions, as in the High Level Architecture. Exact; each pair is reported once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "reckon/bench/interest/overlap_kernel.hpp"
#include "reckon/bench/interest/region.hpp"
#include "reckon/bench/interest/region_grid.hpp"

namespace reckon::bench {

/// Reason why a region matches nothing.
enum class RegionFault : std::uint8_t {
  none,
  not_a_number,  ///< a bound is NaN
  empty,         ///< lower >= upper on some axis: a point, or inverted; see Region for points
};

/// Regions that were left out of a match.
struct RefusedRegions {
  std::size_t count = 0;
  std::size_t first = 0;                  ///< index of the first of them, if count > 0
  RegionFault fault = RegionFault::none;  ///< fault of the first
};

/// Result of a match.
struct RegionMatch {
  std::uint64_t pairs = 0;
  RefusedRegions subscriptions, updates;
};

/// Matches regions in D = 1, 2 or 3 dimensions:
///
///   RegionMatcher<2> matcher;
///   const RegionMatch found = matcher.match(subscriptions, updates,
///       [&](std::span<const RegionPair> pairs) { ... });
///
/// Each update region is stored once, by the cell of its lower corner, in grids by size, so that a
/// few large regions do not slow the small ones. A subscription searches the cells from which a
/// region can reach it. Cells repeat over the plane if it is larger than its content, so that
/// memory depends only on the number of regions, for any sizes and places.
///
/// One thread. Memory is kept between calls: at most 24 D + 24 octets a region and 0.3 MiB. Cost on
/// a busy 2.6 GHz core, for a million regions in the plane: 75 ns a region if few overlap, and 4 ns
/// a pair if many do (docs/area_of_interest_mechanisms.md). If all small regions lie in one corner
/// of very large ones, up to the product of both counts is compared.
template <std::size_t D>
class RegionMatcher {
  static_assert(D >= 1 && D <= 3);

 public:
  /// Greatest number of pairs in one call of the sink.
  static constexpr std::size_t kMostAtOnce = 8192;

  explicit RegionMatcher(SimdLevel level = best_simd_level());

  /// Passes every overlapping pair to `sink(std::span<const RegionPair>)` once. The order is not
  /// sorted. It is the same for the same regions on every processor.
  /// @throws std::length_error above 2^31 regions of a kind @throws whatever `sink` throws
  template <typename Sink>
  RegionMatch match(std::span<const Region<D>> subscriptions, std::span<const Region<D>> updates,
                    Sink&& sink) {
    using Target = std::remove_reference_t<Sink>;
    return match_into(subscriptions, updates,
                      {std::addressof(sink), [](const void* target, Pairs pairs) {
                         (*static_cast<Target*>(const_cast<void*>(target)))(pairs);
                       }});
  }

  /// Memory held now [octets].
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  using Pairs = std::span<const RegionPair>;
  struct SinkRef {
    const void* target;
    void (*give)(const void* target, Pairs pairs);
  };

  RegionMatch match_into(std::span<const Region<D>> subscriptions,
                         std::span<const Region<D>> updates, SinkRef sink);
  void make_grids(std::span<const Region<D>> updates);
  void order_subscriptions(std::span<const Region<D>> subscriptions);
  void match_grid(const RegionGrid<D>& grid, std::span<const Region<D>> subscriptions,
                  const SinkRef& sink);
  void flush(const SinkRef& sink);

  OverlapKernel<D> kernel_;
  std::vector<RegionGrid<D>> grids_;
  std::size_t grid_count_ = 0;
  std::vector<std::uint32_t> update_places_, subscription_places_, order_;
  std::vector<std::uint8_t> size_class_;
  std::vector<RegionPair> waiting_;
  std::size_t waiting_count_ = 0;
  std::uint64_t given_ = 0;
};

}  // namespace reckon::bench

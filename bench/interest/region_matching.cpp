// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/region_matching.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace reckon::bench {
namespace {

// Update regions compared between two checks of the room for pairs.
constexpr std::size_t kChunk = 2048;
// Fewer regions of a size than this share a grid with others: each grid costs every subscription a
// search.
constexpr std::size_t kFewest = 32;
// Sizes within a class differ at most by this factor, except in the smallest and the largest class.
constexpr double kClassFactor = 8.0;
constexpr std::size_t kClasses = 5;

template <std::size_t D>
RegionFault fault_of(const Region<D>& region) noexcept {
  bool valid = true, number = true;
  for (std::size_t axis = 0; axis < D; ++axis) {
    valid = valid && region.lower[axis] < region.upper[axis];
    number = number && !std::isnan(region.lower[axis]) && !std::isnan(region.upper[axis]);
  }
  if (valid) return RegionFault::none;
  return number ? RegionFault::empty : RegionFault::not_a_number;
}

// Indices of the valid regions, in order.
template <std::size_t D>
RefusedRegions keep_valid(std::span<const Region<D>> regions, std::vector<std::uint32_t>& places) {
  if (regions.size() > (std::size_t{1} << 31)) {
    throw std::length_error("region matching allows at most 2^31 regions of a kind, not " +
                            std::to_string(regions.size()));
  }
  RefusedRegions refused;
  places.clear();
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const RegionFault fault = fault_of(regions[i]);
    if (fault == RegionFault::none) {
      places.push_back(static_cast<std::uint32_t>(i));
    } else if (refused.count++ == 0) {
      refused.first = i;
      refused.fault = fault;
    }
  }
  return refused;
}

// Up to these sizes all regions are in one class: the least cell size, or a few times the usual
// size.
template <std::size_t D>
std::array<double, D> small_sizes(std::span<const Region<D>> regions,
                                  std::span<const std::uint32_t> places) {
  std::array<double, D> sizes = cell_sides<D>(regions, places, {});
  std::vector<double> some;
  for (std::size_t axis = 0; axis < D; ++axis) {
    some.clear();
    for (std::size_t i = 0; i < places.size(); i += 1 + places.size() / 1024) {
      some.push_back(regions[places[i]].upper[axis] - regions[places[i]].lower[axis]);
    }
    const auto middle = some.begin() + static_cast<std::ptrdiff_t>(some.size() / 2);
    std::nth_element(some.begin(), middle, some.end());
    sizes[axis] = std::max(sizes[axis], 4.0 * *middle);
  }
  return sizes;
}

template <std::size_t D>
std::uint8_t class_of(const Region<D>& region, const std::array<double, D>& small) noexcept {
  std::size_t name = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    double limit = small[axis];
    std::size_t step = 0;
    for (const double size = region.upper[axis] - region.lower[axis];
         size > limit && step + 1 < kClasses; limit *= kClassFactor) {
      ++step;
    }
    name = name * kClasses + step;
  }
  return static_cast<std::uint8_t>(name);
}

}  // namespace

template <std::size_t D>
RegionMatcher<D>::RegionMatcher(SimdLevel level)
    : kernel_(overlap_kernel<D>(level)), waiting_(kMostAtOnce + kOverlapPadding) {}

template <std::size_t D>
RegionMatch RegionMatcher<D>::match_into(std::span<const Region<D>> subscriptions,
                                         std::span<const Region<D>> updates, SinkRef sink) {
  RegionMatch match;
  match.subscriptions = keep_valid(subscriptions, subscription_places_);
  match.updates = keep_valid(updates, update_places_);
  given_ = 0;
  waiting_count_ = 0;
  if (subscription_places_.empty() || update_places_.empty()) return match;

  make_grids(updates);
  order_subscriptions(subscriptions);
  for (std::size_t i = 0; i < grid_count_; ++i) match_grid(grids_[i], subscriptions, sink);
  flush(sink);
  match.pairs = given_;
  return match;
}

template <std::size_t D>
void RegionMatcher<D>::make_grids(std::span<const Region<D>> updates) {
  const std::array<double, D> small = small_sizes<D>(updates, update_places_);
  std::array<std::size_t, 256> members{};
  size_class_.resize(update_places_.size());
  for (std::size_t i = 0; i < update_places_.size(); ++i) {
    ++members[size_class_[i] = class_of<D>(updates[update_places_[i]], small)];
  }
  // One grid for each frequent size class, and one for all others.
  std::map<std::size_t, std::size_t> grid_of;
  grid_count_ = 0;
  std::size_t rest = members.size();
  for (std::size_t name = 0; name < members.size(); ++name) {
    if (members[name] == 0) continue;
    if (members[name] >= kFewest) {
      grid_of[name] = grid_count_++;
    } else if (rest == members.size()) {
      grid_of[rest = name] = grid_count_++;
    } else {
      grid_of[name] = grid_of[rest];
    }
  }
  if (grids_.size() < grid_count_) grids_.resize(grid_count_);
  if (grid_count_ == 1) return grids_[0].build(updates, update_places_);
  std::vector<std::vector<std::uint32_t>> places(grid_count_);
  for (std::size_t i = 0; i < update_places_.size(); ++i) {
    places[grid_of[size_class_[i]]].push_back(update_places_[i]);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  for (std::size_t i = 0; i < grid_count_; ++i) grids_[i].build(updates, places[i]);
}

template <std::size_t D>
void RegionMatcher<D>::order_subscriptions(std::span<const Region<D>> subscriptions) {
  // Neighbouring subscriptions are matched in sequence, because they read the same update regions.
  const RegionGrid<D>& grid = grids_[0];
  std::vector<std::uint32_t>& cells = update_places_;  // not needed any more
  std::vector<std::uint32_t> starts(grid.cell_count() + 1, 0);
  cells.resize(subscription_places_.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] =
        static_cast<std::uint32_t>(grid.cell_of(subscriptions[subscription_places_[i]].lower));
    ++starts[cells[i]];
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  order_.resize(cells.size());
  for (std::size_t i = cells.size(); i-- > 0;) order_[--starts[cells[i]]] = subscription_places_[i];
}

template <std::size_t D>
void RegionMatcher<D>::match_grid(const RegionGrid<D>& grid,
                                  std::span<const Region<D>> subscriptions, const SinkRef& sink) {
  const RegionColumns<D> columns = grid.columns();
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    // They are scattered in memory: prefetched.
    if (i + kAhead < order_.size()) __builtin_prefetch(&subscriptions[order_[i + kAhead]]);
    const std::uint32_t place = order_[i];
    const Region<D>& subscription = subscriptions[place];
    grid.for_each_run(subscription, [&](std::size_t first, std::size_t count) {
      while (count > 0) {
        const std::size_t now = std::min(count, kChunk);
        waiting_count_ +=
            kernel_(columns, first, now, subscription, place, waiting_.data() + waiting_count_);
        if (waiting_count_ >= kMostAtOnce - kChunk) flush(sink);
        first += now;
        count -= now;
      }
    });
  }
}

template <std::size_t D>
void RegionMatcher<D>::flush(const SinkRef& sink) {
  if (waiting_count_ == 0) return;
  given_ += waiting_count_;
  const std::size_t count = std::exchange(waiting_count_, 0);
  sink.give(sink.target, {waiting_.data(), count});
}

template <std::size_t D>
std::size_t RegionMatcher<D>::memory() const noexcept {
  std::size_t octets =
      sizeof(RegionPair) * waiting_.capacity() + size_class_.capacity() +
      4 * (update_places_.capacity() + subscription_places_.capacity() + order_.capacity());
  for (const RegionGrid<D>& grid : grids_) octets += grid.memory();
  return octets;
}

template class RegionMatcher<1>;
template class RegionMatcher<2>;
template class RegionMatcher<3>;

}  // namespace reckon::bench

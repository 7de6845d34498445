// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/region_grid.hpp"

#include <bit>
#include <limits>
#include <numeric>

namespace reckon::bench {
namespace {

// Up to this number a direct comparison is faster than sorting.
constexpr std::size_t kOneCell = 32;
// Rows across the longest region: more rows avoid comparisons in vain but start more runs.
constexpr double kRowsPerReach = 2.0;
// The same along a row, where the cells of a run are contiguous and cost nothing.
constexpr double kCellsPerReach = 16.0;

constexpr double kNoLimit = std::numeric_limits<double>::max();

double finite(double x) noexcept { return std::clamp(x, -kNoLimit, kNoLimit); }

// Difference, limited to a finite value.
double span_of(double from, double to) noexcept { return std::min(to - from, kNoLimit); }

template <std::size_t D>
using Corners = std::vector<std::array<double, D>>;

// Lower corners of an evenly spaced sample of the regions.
template <std::size_t D>
Corners<D> sample(std::span<const Region<D>> regions, std::span<const std::uint32_t> places) {
  const double root = std::sqrt(static_cast<double>(places.size()));
  const auto wanted = static_cast<std::size_t>(std::clamp(4.0 * root, 64.0, 4096.0));
  const std::size_t step = std::max<std::size_t>(1, places.size() / wanted);
  Corners<D> corners;
  for (std::size_t i = 0; i < places.size(); i += step) {
    corners.push_back(regions[places[i]].lower);
    for (double& x : corners.back()) x = finite(x);
  }
  return corners;
}

// Extent of most of the corners, for each axis; above 0.
template <std::size_t D>
std::array<double, D> spreads(const Corners<D>& corners) {
  std::array<double, D> spread{};
  std::vector<double> values(corners.size());
  for (std::size_t axis = 0; axis < D; ++axis) {
    std::transform(corners.begin(), corners.end(), values.begin(),
                   [axis](const auto& corner) { return corner[axis]; });
    std::sort(values.begin(), values.end());
    const std::size_t tenth = values.size() / 10;
    spread[axis] = span_of(values[tenth], values[values.size() - 1 - tenth]);
    if (!(spread[axis] > 0)) spread[axis] = span_of(values.front(), values.back());
    if (!(spread[axis] > 0)) spread[axis] = 1.0;
  }
  return spread;
}

// Number of pairs of corners that share a cell.
template <std::size_t D>
std::size_t shared(const Corners<D>& corners, const std::array<double, D>& sides,
                   std::vector<std::uint64_t>& keys) {
  keys.clear();
  for (const auto& corner : corners) {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double cell = std::floor(std::clamp(corner[axis] / sides[axis], -1e15, 1e15));
      key = (key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(cell))) *
            0x9E3779B97F4A7C15ULL;
    }
    keys.push_back(key);
  }
  std::sort(keys.begin(), keys.end());
  std::size_t pairs = 0, alike = 0;
  for (std::size_t i = 1; i < keys.size(); ++i) {
    alike = keys[i] == keys[i - 1] ? alike + 1 : 0;
    pairs += alike;
  }
  return pairs;
}

}  // namespace

template <std::size_t D>
std::array<double, D> cell_sides(std::span<const Region<D>> regions,
                                 std::span<const std::uint32_t> places,
                                 const std::array<double, D>& floor) {
  const Corners<D> corners = sample(regions, places);
  const std::array<double, D> spread = spreads<D>(corners);
  const auto sides_of = [&](int halvings) {
    std::array<double, D> sides{};
    for (std::size_t axis = 0; axis < D; ++axis) {
      sides[axis] = std::max(std::ldexp(spread[axis], -halvings), finite(floor[axis]));
      sides[axis] = std::max(sides[axis], std::numeric_limits<double>::min());
    }
    return sides;
  };
  // Two others in a cell on average, over all the regions.
  const std::size_t most = corners.size() * corners.size() / places.size() + 1;
  constexpr int kMostHalvings = 40;
  const std::array<double, D> finest = sides_of(kMostHalvings);
  std::vector<std::uint64_t> keys;
  int crowded = -1, enough = kMostHalvings;
  while (enough - crowded > 1) {
    const int halvings = (crowded + enough) / 2;
    const std::array<double, D> sides = sides_of(halvings);
    const bool fine = sides == finest || shared<D>(corners, sides, keys) <= most;
    (fine ? enough : crowded) = halvings;
  }
  return sides_of(enough);
}

template <std::size_t D>
void RegionGrid<D>::choose_cells(std::span<const Region<D>> regions,
                                 std::span<const std::uint32_t> places) {
  std::array<double, D> floor{}, least{}, greatest{};
  least.fill(kNoLimit);
  greatest.fill(-kNoLimit);
  axes_ = {};
  for (const std::uint32_t place : places) {
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double lower = finite(regions[place].lower[axis]);
      least[axis] = std::min(least[axis], lower);
      greatest[axis] = std::max(greatest[axis], lower);
      axes_[axis].reach =
          std::max(axes_[axis].reach, regions[place].upper[axis] - regions[place].lower[axis]);
    }
  }
  if (places.size() <= kOneCell) return;
  for (std::size_t axis = 0; axis < D; ++axis) {
    floor[axis] = axes_[axis].reach / (axis == 0 ? kCellsPerReach : kRowsPerReach);
  }
  const std::array<double, D> sides = cell_sides<D>(regions, places, floor);
  for (std::size_t axis = 0; axis < D; ++axis) {
    Axis& along = axes_[axis];
    const double cells = span_of(least[axis], greatest[axis]) / sides[axis];
    if (!(cells >= 1.0)) continue;
    along.origin = least[axis];
    along.per_unit = 1.0 / sides[axis];
    along.count = static_cast<std::size_t>(std::min(cells, 1e12)) + 1;
  }
  limit_cells(2 * places.size());
}

template <std::size_t D>
void RegionGrid<D>::limit_cells(std::size_t most) {
  const auto cells = [this] {
    double product = 1;
    for (const Axis& axis : axes_) product *= static_cast<double>(axis.count);
    return product;
  };
  while (cells() > static_cast<double>(most)) {
    Axis& longest = *std::max_element(
        axes_.begin(), axes_.end(), [](const Axis& a, const Axis& b) { return a.count < b.count; });
    longest.count = std::bit_ceil(longest.count) / 2;
    longest.repeats = true;
  }
}

template <std::size_t D>
void RegionGrid<D>::build(std::span<const Region<D>> regions,
                          std::span<const std::uint32_t> places) {
  choose_cells(regions, places);
  std::size_t cells = 1;
  for (const Axis& axis : axes_) cells *= axis.count;
  starts_.assign(cells + 1, 0);
  cell_.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    cell_[i] = static_cast<std::uint32_t>(cell_of(regions[places[i]].lower));
    ++starts_[cell_[i]];
  }
  // Each start is the end of its cell at first and is decremented as the cell fills.
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());

  const std::size_t padded = places.size() + kOverlapPadding;
  for (std::size_t axis = 0; axis < D; ++axis) {
    lower_[axis].resize(padded);
    upper_[axis].resize(padded);
  }
  place_.resize(padded);
  for (std::size_t i = places.size(); i-- > 0;) place_[--starts_[cell_[i]]] = places[i];
  // Scattered reads and sequential writes: the reverse would make each write wait for a cache line.
  for (std::size_t to = 0; to < places.size(); ++to) {
    const Region<D>& region = regions[place_[to]];
    for (std::size_t axis = 0; axis < D; ++axis) {
      lower_[axis][to] = region.lower[axis];
      upper_[axis][to] = region.upper[axis];
    }
  }
}

template <std::size_t D>
RegionColumns<D> RegionGrid<D>::columns() const noexcept {
  RegionColumns<D> columns;
  for (std::size_t axis = 0; axis < D; ++axis) {
    columns.lower[axis] = lower_[axis].data();
    columns.upper[axis] = upper_[axis].data();
  }
  columns.place = place_.data();
  return columns;
}

template <std::size_t D>
std::size_t RegionGrid<D>::memory() const noexcept {
  std::size_t octets = 4 * (starts_.capacity() + place_.capacity() + cell_.capacity());
  for (std::size_t axis = 0; axis < D; ++axis) {
    octets += sizeof(double) * (lower_[axis].capacity() + upper_[axis].capacity());
  }
  return octets;
}

template std::array<double, 1> cell_sides(std::span<const Region<1>>,
                                          std::span<const std::uint32_t>,
                                          const std::array<double, 1>&);
template std::array<double, 2> cell_sides(std::span<const Region<2>>,
                                          std::span<const std::uint32_t>,
                                          const std::array<double, 2>&);
template std::array<double, 3> cell_sides(std::span<const Region<3>>,
                                          std::span<const std::uint32_t>,
                                          const std::array<double, 3>&);
template class RegionGrid<1>;
template class RegionGrid<2>;
template class RegionGrid<3>;

}  // namespace reckon::bench

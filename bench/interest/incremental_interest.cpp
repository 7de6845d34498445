// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/incremental_interest.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace reckon::bench {
namespace {

constexpr double kLeastReach = 1e-3;  // [m], so that the size of a cell is above 0
constexpr double kLeastPace = 0.02;   // of the reach, so that a crowd at rest may begin to walk
constexpr double kMostPace = 0.25;    // of the reach; above it too many lie near the edge
constexpr double kCostApart = 16.0;   // cost of a separate comparison over one by layout
constexpr std::size_t kAhead = 24;    // distance of prefetches, in entities

// Counts values by powers of two of a unit.
struct Bins {
  static constexpr std::size_t kCount = 64;
  std::array<double, kCount> greatest{};
  std::array<double, kCount> members{};

  std::size_t add(double value, double unit) noexcept {
    const int power = value > 0 ? std::ilogb(value / unit) : -100;
    const auto bin = static_cast<std::size_t>(std::clamp(power, -32, 31) + 32);
    members[bin] += 1;
    greatest[bin] = std::max(greatest[bin], value);
    return bin;
  }
};

}  // namespace

IncrementalInterest::IncrementalInterest(std::size_t capacity, SimdLevel level)
    : level_(level), present_(capacity), listed_(capacity), changes_(capacity) {
  for (Hearer& hearer : present_) hearer.squared_radius = kAbsent;
  from_.resize(1);
  into_.resize(1);
}

void IncrementalInterest::add(std::uint32_t entity, const aoim::Position& position, double radius) {
  assert(entity < present_.size() && !holds(entity));
  ++size_;
  ++came_or_went_;
  present_[entity] = {position, radius >= 0 ? radius * radius : Hearer::kNobody};
  if (listed_[entity] != 0) return;
  listed_[entity] = 1;
  coming_.push_back(entity);
}

void IncrementalInterest::remove(std::uint32_t entity) noexcept {
  assert(holds(entity));
  --size_;
  ++came_or_went_;
  present_[entity].squared_radius = kAbsent;
}

void IncrementalInterest::move(std::uint32_t entity, const aoim::Position& position) noexcept {
  assert(holds(entity));
  present_[entity].position = position;
}

std::span<const HearingChange> IncrementalInterest::step() {
  changes_.clear();
  std::swap(now_, before_);
  if (4 * came_or_went_ > size_) choose_reach();
  plan();
  sight_those_before();
  sight_those_coming();
  const bool most_leapt = 2 * (leapt_ + gone_.size()) > placed_;
  lay_out(most_leapt);
  set_apart(most_leapt);
  if (most_leapt) {
    compare_all();
  } else {
    compare_near_edges();
  }
  compare_apart();
  choose_pace();
  return changes_.sorted();
}

// Chooses the greatest radius of entities that are compared by layout: the radius of least total
// cost.
void IncrementalInterest::choose_reach() {
  came_or_went_ = 0;
  Bins bins;
  std::array<double, Bins::kCount> area{};
  for (const Hearer& hearer : present_) {
    const double squared = hearer.squared_radius;
    if (!(squared >= 0 && squared < 1e18)) continue;
    area[bins.add(squared, 1.0)] += squared;
  }
  double best = kLeastReach * kLeastReach, least = std::numeric_limits<double>::infinity();
  double members = 0, beyond = 0;
  for (std::size_t bin = 0; bin < Bins::kCount; ++bin) members += bins.members[bin];
  for (std::size_t bin = Bins::kCount; bin-- > 0;) {
    if (bins.members[bin] == 0) continue;
    const double cost = members * bins.greatest[bin] + kCostApart * beyond;
    if (cost < least) {
      least = cost;
      best = bins.greatest[bin];
    }
    beyond += area[bin];
    members -= bins.members[bin];
  }
  reach_ = std::max(kLeastReach, std::sqrt(best) * (1.0 + 1e-15));
}

// Chooses the distance that an entity may move in the next tick and still count as calm. If it is
// greater, more entities lie near an edge; if it is smaller, more leap. Judged by a sample of the
// movements of this tick.
void IncrementalInterest::choose_pace() {
  Bins bins;
  const std::uint32_t step = 1 + now_.size() / 1024;
  double all = 0;
  for (std::uint32_t slot = 0; slot < now_.size(); slot += step) {
    const Hearer& before = before_.hearer(from_[slot]);
    if (std::isnan(before.position.x)) continue;
    bins.add(squared_distance(before.position, now_.hearer(slot).position), reach_ * reach_);
    all += 1;
  }
  double best = 0, least = std::numeric_limits<double>::infinity(), beyond = 0;
  for (std::size_t bin = Bins::kCount; bin-- > 0;) {
    if (bins.members[bin] == 0) continue;
    const double pace = std::sqrt(bins.greatest[bin]) / reach_;
    const double cost = pace + beyond / all;
    if (cost < least && pace < kMostPace) {
      least = cost;
      best = pace;
    }
    beyond += bins.members[bin];
  }
  pace_ = reach_ * std::clamp(1.25 * best, kLeastPace, kMostPace);
}

void IncrementalInterest::plan() {
  pace_ = std::clamp(pace_, kLeastPace * reach_, kMostPace * reach_);
  const std::size_t most = before_.size() + coming_.size();
  now_.plan(most, reach_, 2.0 * pace_, surroundings());
  hearers_.resize(most);
  sighted_.resize(most);
  farthest_squared_ = 0;
  leapt_ = placed_ = 0;
  arrived_.clear();
  gone_.clear();
  apart_.clear();
}

// Middle and extent for each axis, from a sample of the entities.
Surroundings IncrementalInterest::surroundings() const {
  constexpr std::size_t kSome = 65;
  std::array<std::array<double, kSome>, 3> axes{};
  std::size_t count = 0;
  const auto add = [&](const aoim::Position& position) {
    if (!aoim::is_finite(position) || count == kSome) return;
    axes[0][count] = position.x;
    axes[1][count] = position.y;
    axes[2][count++] = position.z;
  };
  const std::size_t step = 1 + before_.size() / kSome, coming_step = 1 + coming_.size() / kSome;
  for (std::size_t slot = 0; slot < before_.size(); slot += step)
    add(before_.hearer(slot).position);
  for (std::size_t i = 0; i < coming_.size(); i += coming_step) add(present_[coming_[i]].position);
  if (count == 0) return {};
  for (auto& axis : axes) std::sort(axis.begin(), axis.begin() + count);
  const auto at = [&](std::size_t i) { return aoim::Position{axes[0][i], axes[1][i], axes[2][i]}; };
  return {at(count / 2), at(0), at(count - 1)};
}

// Whether an entity that was present before is calm: it moved so little that only pairs near an
// edge may differ.
Apart IncrementalInterest::judge(std::uint32_t slot, const Hearer& hearer) noexcept {
  const Hearer& before = before_.hearer(slot);
  if (before_.apart(slot) == Apart::far || !now_.fits(hearer)) return Apart::far;
  const double gone = squared_distance(before.position, hearer.position);
  if (!(gone <= pace_ * pace_) || before.squared_radius != hearer.squared_radius) {
    return Apart::leapt;
  }
  farthest_squared_ = std::max(farthest_squared_, gone);
  return Apart::no;
}

void IncrementalInterest::sight(std::size_t at, const Hearer& hearer, Apart apart) noexcept {
  hearers_[at] = hearer;
  sighted_[at] = {now_.cell_of(hearer.position), apart};
  now_.count(sighted_[at].cell);
  if (apart == Apart::leapt) ++leapt_;
  ++placed_;
}

void IncrementalInterest::sight_those_before() {
  const std::uint32_t count = before_.size();
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    if (slot + kAhead < count) __builtin_prefetch(&present_[before_.entity(slot + kAhead)]);
    const std::uint32_t entity = before_.entity(slot);
    const Hearer& hearer = present_[entity];
    if (hearer.squared_radius != kAbsent && aoim::is_finite(hearer.position)) {
      sight(slot, hearer, judge(slot, hearer));
      continue;
    }
    sighted_[slot] = {};
    gone_.push_back(slot);
    if (hearer.squared_radius == kAbsent) {
      listed_[entity] = 0;
    } else {
      coming_.push_back(entity);
    }
  }
}

void IncrementalInterest::sight_those_coming() {
  std::size_t staying = 0;
  for (const std::uint32_t entity : coming_) {
    const Hearer& hearer = present_[entity];
    if (hearer.squared_radius == kAbsent) {
      listed_[entity] = 0;
    } else if (aoim::is_finite(hearer.position)) {
      sight(before_.size() + arrived_.size(), hearer,
            now_.fits(hearer) ? Apart::leapt : Apart::far);
      arrived_.push_back(entity);
    } else {
      coming_[staying++] = entity;
    }
  }
  coming_.resize(staying);
}

void IncrementalInterest::lay_out(bool most_leapt) {
  now_.sort_cells();
  const std::uint32_t count = before_.size();
  from_.resize(placed_ + 1);
  from_[placed_] = count;
  const auto put = [&](std::size_t at, std::uint32_t entity, std::uint32_t from) {
    const Sighted& sighted = sighted_[at];
    if (sighted.cell == kNowhere) return;
    const Apart apart = most_leapt && sighted.apart == Apart::leapt ? Apart::no : sighted.apart;
    const std::uint32_t slot = now_.put(sighted.cell, entity, hearers_[at], apart);
    from_[slot] = from;
    if (apart != Apart::no) apart_.push_back({slot, from});
  };
  for (std::uint32_t slot = 0; slot < count; ++slot) put(slot, before_.entity(slot), slot);
  for (std::size_t i = 0; i < arrived_.size(); ++i) put(count + i, arrived_[i], count);
}

// Marks the same entities as apart in both layouts.
void IncrementalInterest::set_apart(bool most_leapt) {
  for (const std::uint32_t slot : gone_) {
    if (most_leapt && before_.apart(slot) != Apart::far) continue;
    apart_.push_back({now_.size(), slot});
  }
  if (apart_.empty() && !most_leapt) return;
  into_.assign(before_.size() + 1, now_.size());
  for (std::uint32_t slot = 0; slot < now_.size(); ++slot) into_[from_[slot]] = slot;
  into_[before_.size()] = now_.size();
  before_.clear_apart();
  for (const Slots& slots : apart_) before_.set_apart(slots.before, Apart::leapt);
}

// Compares each pair that is within the border in `here`.
void IncrementalInterest::compare(const NeighbourLayout& here, const NeighbourLayout& there,
                                  const Link& link, ChangeTold told) {
  const ChangeKernel kernel = change_kernel(level_, told);
  const ChangeColumns columns = here.beside(there, link.data());
  here.for_each_border(
      level_, pairs_, [&](const std::uint32_t* own, const std::uint32_t* other, std::size_t count) {
        std::uint64_t* out = changes_.room(2 * count + 1);
        changes_.commit(kernel(columns, own, other, count, out));
      });
}

void IncrementalInterest::compare_near_edges() {
  const double border = 2.0 * std::sqrt(farthest_squared_) * (1.0 + 1e-9);
  now_.set_border(border, border);
  compare(now_, before_, from_, ChangeTold::both);
}

// First the pairs that receive now and did not before, then the pairs that did and do not now.
void IncrementalInterest::compare_all() {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  now_.set_border(kAll, 0.0);
  compare(now_, before_, from_, ChangeTold::began);
  before_.set_border(kAll, 0.0);
  compare(before_, now_, into_, ChangeTold::ceased);
}

void IncrementalInterest::compare_apart() {
  for (const Slots& slots : apart_) {
    compare_one(now_, slots.now, before_, slots.before, from_, true);
    compare_one(before_, slots.before, now_, slots.now, into_, false);
  }
}

// Changes of an entity that is apart: the others that it receives here and not there, and the
// reverse. If both entities of a pair are apart, the change is written from the side of the
// receiver.
void IncrementalInterest::compare_one(const NeighbourLayout& here, std::uint32_t slot,
                                      const NeighbourLayout& there, std::uint32_t slot_there,
                                      const Link& link, bool heard) {
  if (slot == here.size()) return;
  const Hearer own = here.hearer(slot), own_there = there.hearer(slot_there);
  const double range = std::max(here.reach(), std::sqrt(std::max(0.0, own.squared_radius)));
  here.for_each_near(own.position, range * (1.0 + 1e-15), [&](std::uint32_t other) {
    if (other == slot) return;
    const Hearer &one = here.hearer(other), &one_there = there.hearer(link[other]);
    const double squared = squared_distance(own.position, one.position);
    const double squared_there = squared_distance(own_there.position, one_there.position);
    if (own.hears(squared) && !own_there.hears(squared_there)) {
      changes_.put({here.entity(slot), here.entity(other), heard});
    }
    if (!here.is_apart(other) && one.hears(squared) && !one_there.hears(squared_there)) {
      changes_.put({here.entity(other), here.entity(slot), heard});
    }
  });
}

std::size_t IncrementalInterest::memory() const noexcept {
  return now_.memory() + before_.memory() + changes_.memory() +
         sizeof(Hearer) * (present_.capacity() + hearers_.capacity()) + listed_.capacity() +
         sizeof(Sighted) * sighted_.capacity() + sizeof(Slots) * apart_.capacity() +
         4 * (coming_.capacity() + from_.capacity() + into_.capacity() + arrived_.capacity() +
              gone_.capacity() + pairs_.own.capacity() + pairs_.other.capacity());
}

}  // namespace reckon::bench

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/incremental_interest.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>

namespace reckon::aoim {
namespace {

// How far an entity may drift within a layout, of the reach: more compares more pairs in vain, less
// makes layouts more often.
constexpr double kDrift = 0.15;
constexpr double kLeastReach = 1e-3;  // [m], so that a cell has a side

double squared_distance(const Position& a, const Position& b) noexcept {
  const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
  return dx * dx + dy * dy + dz * dz;
}

}  // namespace

IncrementalInterest::IncrementalInterest(std::size_t capacity, SimdLevel level)
    : level_(level), places_(capacity) {
  for (NeighbourLayout* layout : {&layout_, &made_}) {
    layout->plan(0, kLeastReach, 0.0);
    layout->sort_cells(0);
    layout->clear_bits();
  }
  first_of_.resize(capacity + 1);
  anchors_.reserve(capacity);
  announced_.reserve(capacity);
}

void IncrementalInterest::add(std::uint32_t entity, const Position& position, double radius) {
  assert(entity < places_.size() && !holds(entity));
  ++size_;
  places_[entity].radius = radius >= 0 ? radius : -1.0;
  loosen(entity, position);
}

void IncrementalInterest::remove(std::uint32_t entity) noexcept {
  assert(holds(entity));
  Place& place = places_[entity];
  --size_;
  if (place.slot == kLoose) {
    drop_loose(entity);
  } else {
    layout_.empty(place.slot);
  }
  place.slot = kAbsent;
}

void IncrementalInterest::move(std::uint32_t entity, const Position& position) {
  assert(holds(entity));
  const Place& place = places_[entity];
  if (place.slot == kLoose) {
    loose_[place.loose].position = position;
  } else if (layout_.drift_squared(place.slot, position) <= layout_.drift() * layout_.drift()) {
    layout_.move(place.slot, position);
  } else {
    layout_.empty(place.slot);
    loosen(entity, position);
  }
}

void IncrementalInterest::loosen(std::uint32_t entity, const Position& position) {
  places_[entity].slot = kLoose;
  places_[entity].loose = static_cast<std::uint32_t>(loose_.size());
  loose_.push_back({entity, position});
}

void IncrementalInterest::drop_loose(std::uint32_t entity) noexcept {
  const std::uint32_t place = places_[entity].loose;
  loose_[place] = loose_.back();
  places_[loose_[place].entity].loose = place;
  loose_.pop_back();
}

Position IncrementalInterest::position_of(std::uint32_t entity) const noexcept {
  const Place& place = places_[entity];
  return place.slot == kLoose ? loose_[place.loose].position : layout_.position(place.slot);
}

std::span<const HearingChange> IncrementalInterest::step() {
  changes_.clear();
  ++age_;
  ++made_age_;
  // Loose ones are compared with each other, which is for few.
  if (loose_.size() * loose_.size() > 64 * size_ && loose_.size() > 64) start_afresh();
  layout_.compare(level_, changes_);
  compare_loose();
  sort_changes();
  if (making_ == Making::nothing) begin_making();
  make_some(share_of_making());
  return changes_;
}

void IncrementalInterest::find_loose_hearings(std::vector<Hearing>& hearings) {
  hearings.clear();
  const auto compare = [&](std::uint32_t a, const Position& at, std::uint32_t b,
                           const Position& bt) {
    const double squared = squared_distance(at, bt);
    const double ra = places_[a].radius, rb = places_[b].radius;
    if (ra >= 0 && squared <= ra * ra) hearings.push_back({a, b});
    if (rb >= 0 && squared <= rb * rb) hearings.push_back({b, a});
  };
  for (std::size_t i = 0; i < loose_.size(); ++i) {
    const Loose& own = loose_[i];
    if (!is_finite(own.position)) continue;
    const double range = std::max(places_[own.entity].radius, layout_.reach());
    layout_.for_each_near(own.position, range, [&](std::size_t slot) {
      if (!layout_.is_empty(slot)) {
        compare(own.entity, own.position, layout_.entity(slot), layout_.position(slot));
      }
    });
    for (std::size_t j = i + 1; j < loose_.size(); ++j) {
      compare(own.entity, own.position, loose_[j].entity, loose_[j].position);
    }
  }
  std::sort(hearings.begin(), hearings.end());
}

void IncrementalInterest::compare_loose() {
  find_loose_hearings(loose_now_);
  const auto tell = [&](const std::vector<Hearing>& in, const std::vector<Hearing>& out,
                        bool heard) {
    std::vector<Hearing> only;
    std::set_difference(in.begin(), in.end(), out.begin(), out.end(), std::back_inserter(only));
    for (const Hearing& hearing : only) {
      changes_.push_back({hearing.observer, hearing.entity, heard});
    }
  };
  tell(loose_now_, loose_before_, true);
  tell(loose_before_, loose_now_, false);
  loose_before_.swap(loose_now_);
}

void IncrementalInterest::sort_changes() {
  // By observer in one pass, for a sort that compares costs more than all that was compared before.
  std::fill(first_of_.begin(), first_of_.end(), 0U);
  for (const HearingChange& change : changes_) ++first_of_[change.observer];
  std::partial_sum(first_of_.begin(), first_of_.end(), first_of_.begin());
  sorted_.resize(changes_.size());
  for (const HearingChange& change : changes_) sorted_[--first_of_[change.observer]] = change;

  // A pair that went from one way of comparing to another is told twice, each time the other way.
  changes_.clear();
  for (std::size_t begin = 0, end = 0; begin < sorted_.size(); begin = end) {
    while (end < sorted_.size() && sorted_[end].observer == sorted_[begin].observer) ++end;
    std::sort(sorted_.begin() + static_cast<std::ptrdiff_t>(begin),
              sorted_.begin() + static_cast<std::ptrdiff_t>(end),
              [](const HearingChange& a, const HearingChange& b) { return a.entity < b.entity; });
    for (std::size_t i = begin; i < end; ++i) {
      if (i + 1 < end && sorted_[i].entity == sorted_[i + 1].entity) {
        ++i;
      } else {
        changes_.push_back(sorted_[i]);
      }
    }
  }
}

// Up to where those hear that are compared by layout: the radius by which all of it costs least.
double IncrementalInterest::typical_reach() {
  constexpr int kBins = 64, kZero = 32;
  std::array<double, kBins> area{}, greatest{};
  std::array<std::size_t, kBins> members{};
  std::size_t all = 0;
  for (const Place& place : places_) {
    if (place.slot == kAbsent || !(place.radius < 1e9)) continue;
    const double radius = std::max(place.radius, kLeastReach);
    const auto bin = static_cast<std::size_t>(std::clamp(std::ilogb(radius) + kZero, 0, kBins - 1));
    ++members[bin];
    area[bin] += radius * radius;
    greatest[bin] = std::max(greatest[bin], radius);
    ++all;
  }
  double best = kLeastReach, least = INFINITY, beyond = 0;
  std::size_t apart = 0;
  for (std::size_t bin = kBins; bin-- > 0;) {
    if (members[bin] == 0) continue;
    const double cost = static_cast<double>(all - apart) * greatest[bin] * greatest[bin] +
                        16.0 * beyond + (apart > 64 && apart * apart > 16 * all ? INFINITY : 0.0);
    if (cost < least) {
      least = cost;
      best = greatest[bin];
    }
    beyond += area[bin];
    apart += members[bin];
  }
  return best;
}

bool IncrementalInterest::fits(const Place& place, const Position& position, double reach) const {
  return place.slot != kAbsent && place.radius <= reach && is_finite(position);
}

void IncrementalInterest::begin_making() {
  const double reach = typical_reach();
  made_.plan(size_, reach, kDrift * reach);
  anchors_.clear();
  announced_.clear();
  made_to_ = 0;
  made_age_ = 0;
  making_ = Making::announcing;
}

// In the order of the old layout, where neighbours lie side by side, and then the loose ones.
void IncrementalInterest::make_some(std::size_t entities) {
  const auto announce = [&](std::uint32_t entity, const Position& position) {
    if (!fits(places_[entity], position, made_.reach())) return;
    made_.announce(position);
    announced_.push_back(entity);
    anchors_.push_back(position);
  };
  while (making_ == Making::announcing && entities > 0) {
    if (made_to_ == layout_.size()) {
      for (const Loose& loose : loose_) announce(loose.entity, loose.position);
      made_.sort_cells(announced_.size());
      made_to_ = 0;
      making_ = Making::putting;
      break;
    }
    --entities;
    const std::size_t slot = made_to_++;
    if (!layout_.is_empty(slot)) announce(layout_.entity(slot), layout_.position(slot));
  }
  while (making_ == Making::putting && entities > 0) {
    if (made_to_ == announced_.size()) return take_made();
    --entities;
    made_.put(announced_[made_to_], anchors_[made_to_]);
    ++made_to_;
  }
}

std::size_t IncrementalInterest::share_of_making() const {
  // From some of them: how many ticks until the fastest have drifted as far as they may.
  double farthest = 0;
  const std::size_t step = 1 + layout_.size() / 512;
  for (std::size_t slot = 0; slot < layout_.size(); slot += step) {
    if (!layout_.is_empty(slot)) {
      farthest = std::max(farthest, layout_.drift_squared(slot, layout_.position(slot)));
    }
  }
  if (farthest == 0 && loose_.empty()) return 0;
  const double gone = std::sqrt(farthest), each = gone / std::max(1, age_);
  const double ticks = each > 0 ? 0.8 * (layout_.drift() - gone) / each : 16.0;
  const std::size_t work = making_ == Making::announcing
                               ? 2 * layout_.size() - made_to_ + loose_.size()
                               : announced_.size() - made_to_;
  return 64 + static_cast<std::size_t>(static_cast<double>(work) / std::clamp(ticks, 1.0, 64.0));
}

// Goes over to the new layout: bits and loose hearings as they are now, so that nothing is told.
void IncrementalInterest::take_made() {
  // Who became loose or came again meanwhile may have been announced twice: the first slot counts.
  std::vector<std::uint32_t>& slot_of = first_of_;
  std::fill(slot_of.begin(), slot_of.end(), kAbsent);
  for (std::uint32_t slot = 0; slot < made_.size(); ++slot) {
    const std::uint32_t entity = made_.entity(slot);
    made_.empty(slot);
    if (!holds(entity) || slot_of[entity] != kAbsent) continue;
    const Position position = position_of(entity);
    const bool near = made_.drift_squared(slot, position) <= made_.drift() * made_.drift();
    if (!near || !fits(places_[entity], position, made_.reach())) continue;
    made_.fill(slot, position, places_[entity].radius);
    slot_of[entity] = slot;
  }
  std::vector<Loose> rest;
  const auto settle = [&](std::uint32_t entity, const Position& position) {
    places_[entity].slot = slot_of[entity];
    if (slot_of[entity] == kAbsent) rest.push_back({entity, position});
  };
  for (const Loose& loose : loose_) settle(loose.entity, loose.position);
  for (std::size_t slot = 0; slot < layout_.size(); ++slot) {
    if (!layout_.is_empty(slot)) settle(layout_.entity(slot), layout_.position(slot));
  }
  loose_.clear();
  for (const Loose& loose : rest) loosen(loose.entity, loose.position);

  std::swap(layout_, made_);
  layout_.set_bits(level_);
  find_loose_hearings(loose_before_);
  age_ = made_age_;
  making_ = Making::nothing;
}

// Too many have come or leapt: all that was heard is taken back, and all is told again; what is
// told both ways falls out when the changes are sorted.
void IncrementalInterest::start_afresh() {
  layout_.take_back(changes_);
  for (const Hearing& hearing : loose_before_) {
    changes_.push_back({hearing.observer, hearing.entity, false});
  }
  begin_making();
  while (making_ != Making::nothing) make_some(places_.size() + 64);
  layout_.clear_bits();
  loose_before_.clear();
}

std::size_t IncrementalInterest::memory() const noexcept {
  return layout_.memory() + made_.memory() + sizeof(Place) * places_.capacity() +
         sizeof(Loose) * loose_.capacity() +
         sizeof(Hearing) * (loose_before_.capacity() + loose_now_.capacity()) +
         sizeof(HearingChange) * (changes_.capacity() + sorted_.capacity()) +
         4 * (first_of_.capacity() + announced_.capacity()) +
         sizeof(Position) * anchors_.capacity();
}

}  // namespace reckon::aoim

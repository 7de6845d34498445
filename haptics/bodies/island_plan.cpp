// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/island_plan.hpp"

#include <algorithm>
#include <bit>

#include "reckon/haptics/bodies/counted_work.hpp"

namespace reckon::haptics {
namespace {

// Iterations times contacts of the iterative solver, which bounds the time of a step.
constexpr int kIterations = 2000, kFewest = 10, kMost = 30;

// Counted work of the cheapest solution.
double least_of(int contacts) noexcept {
  if (contacts == 0) return 0.0;
  const double iterated = CountedWork::iterated(contacts, kFewest);
  return contacts > IslandPlan::kMostExact ? iterated
                                           : std::min(iterated, CountedWork::exact(contacts));
}

int most_iterations(int contacts) noexcept {
  return std::clamp(kIterations / std::max(contacts, 1), kFewest, kMost);
}

}  // namespace

int IslandPlan::iterations_of(const PlannedIsland& island) noexcept {
  return island.iterations > 0 ? island.iterations : most_iterations(island.contacts);
}

double IslandPlan::work_of(double contacts) noexcept {
  return contacts <= kMostExact
             ? CountedWork::exact(contacts)
             : CountedWork::iterated(contacts, most_iterations(static_cast<int>(contacts)));
}

void IslandPlan::make(BodySet bodies, IslandEnergy::Islands& islands, BodySet pushed,
                      double seconds) noexcept {
  list(bodies, islands);
  iterated_ = 0;
  seconds_ = 0.0;
  bool is_any_large = false;
  for (const PlannedIsland& island : all()) {
    seconds_ += CountedWork::exact(island.contacts);
    is_any_large |= island.contacts > kMostExact;
  }
  if (!is_any_large && seconds_ <= seconds) return;
  // Each island has its cheapest solution; what is left goes to exact ones, then to iterations.
  double rest = seconds;
  for (const PlannedIsland& island : all()) rest -= least_of(island.contacts);
  choose_exact(pushed, rest);
  choose_iterations(rest);
}

void IslandPlan::list(BodySet bodies, IslandEnergy::Islands& islands) noexcept {
  std::array<std::size_t, BodySlots::kMost> number;  // by the island's root
  BodySet known = 0;
  count_ = 0;
  for (BodySet left = bodies; left != 0; left &= left - 1) {
    const auto slot = static_cast<std::size_t>(std::countr_zero(left));
    const std::size_t root = islands.island_of(slot);
    if ((known >> root & 1) == 0) {
      known |= BodySet{1} << root;
      number[root] = count_;
      islands_[count_++] = {0, islands.contacts_of(slot), true, 0};
    }
    islands_[number[root]].bodies |= BodySet{1} << slot;
  }
}

void IslandPlan::choose_exact(BodySet pushed, double& rest) noexcept {
  std::array<std::size_t, BodySlots::kMost> order;
  for (std::size_t i = 0; i < count_; ++i) order[i] = i;
  const auto is_before = [&](std::size_t a, std::size_t b) {
    const bool a_pushed = (islands_[a].bodies & pushed) != 0;
    const bool b_pushed = (islands_[b].bodies & pushed) != 0;
    if (a_pushed != b_pushed) return a_pushed;
    return islands_[a].contacts != islands_[b].contacts
               ? islands_[a].contacts < islands_[b].contacts
               : a < b;
  };
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count_), is_before);
  for (const std::size_t i : std::span(order).first(count_)) {
    PlannedIsland& island = islands_[i];
    if (island.contacts == 0) continue;
    const double more = CountedWork::exact(island.contacts) - least_of(island.contacts);
    island.is_exact = island.contacts <= kMostExact && more <= std::max(rest, 0.0);
    if (island.is_exact) rest -= more;
    if (!island.is_exact) iterated_ |= island.bodies;
  }
}

void IslandPlan::choose_iterations(double rest) noexcept {
  double contacts = 0.0;
  for (const PlannedIsland& island : islands())
    if (!island.is_exact) contacts += island.contacts;
  const double more = contacts > 0 ? std::max(rest, 0.0) / (CountedWork::kSweep * contacts) : 0.0;
  seconds_ = 0.0;
  for (PlannedIsland& island : all()) {
    if (!island.is_exact)
      island.iterations = static_cast<int>(
          std::min(kFewest + more, static_cast<double>(most_iterations(island.contacts))));
    seconds_ += island.is_exact ? CountedWork::exact(island.contacts)
                                : CountedWork::iterated(island.contacts, island.iterations);
  }
}

}  // namespace reckon::haptics

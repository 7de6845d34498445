// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/subscription.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "reckon/pdu/seconds.hpp"

namespace reckon::aoim {
namespace {

constexpr double kOutOfReach = std::numeric_limits<double>::infinity();

// 0 at the focus, 1 at the edge of its radius; a focus of radius 0 needs only its own cell.
double share(double distance, double radius) noexcept {
  if (distance <= 0.0) return 0.0;
  return radius > 0.0 ? distance / radius : kOutOfReach;
}

}  // namespace

Subscription::Subscription(const CellPartition& cells, const SubscriptionConfig& config)
    : cells_(cells), config_(config), entries_(cells.groups()) {
  if (!(config.leave_factor >= 1.0))
    throw std::invalid_argument("leave factor below 1: groups would flap");
  if (config.minimum_stay.count() < 0 || config.lookahead.count() < 0) {
    throw std::invalid_argument("minimum stay and lookahead must not be negative");
  }
  if (config.maximum_groups == 0) throw std::invalid_argument("a cap of 0 groups: take 1 or more");
  name_cells();
  wanted_.reserve(entries_.size());
  joined_.reserve(entries_.size());
  join_.reserve(entries_.size());
  leave_.reserve(entries_.size());
}

// Until a focus reaches a cell of a group, any of its cells represents it.
void Subscription::name_cells() {
  for (std::size_t i = 0; i < cells_.groups(); ++i) {
    entries_[i].cell = cells_.cell_of({static_cast<std::uint16_t>(i + 1)});
  }
}

SubscriptionChange Subscription::update(std::span<const Focus> foci, std::chrono::nanoseconds now,
                                        std::span<const GroupIndex> besides) {
  for (Entry& entry : entries_) entry.reach = entry.cover = kOutOfReach;
  for (const Focus& focus : foci) measure(focus);
  for (const GroupIndex group : besides) entries_[group.value - 1u].reach = 0.0;
  choose(now);
  return apply(now);
}

bool Subscription::is_joined(GroupIndex group) const noexcept {
  return group.value >= 1 && group.value <= entries_.size() && entries_[group.value - 1u].joined;
}

void Subscription::measure(const Focus& focus) {
  const double radius = std::min(focus.radius, focus.cut);
  if (!is_finite(focus.position) || !(radius >= 0.0) || !(focus.speed >= 0.0)) return;

  // Every path of this speed stays within this disc, however it turns.
  const double ahead = focus.speed * pdu::to_seconds(config_.lookahead);
  const double widest = config_.leave_factor * radius + ahead;

  cells_.visit([&](const auto& scheme) {
    // A disc with far more cells than there are groups reaches all groups.
    if (!(scheme.cells_bound(widest) < 64.0 * static_cast<double>(entries_.size()) + 1024.0)) {
      for (Entry& entry : entries_) entry.reach = entry.cover = 0.0;
      return;
    }
    const auto reach = [&](CellId cell, double distance) {
      Entry& entry = entries_[scheme.group(cell).value - 1u];
      entry.reach = std::min(entry.reach, share(distance - ahead, radius));
      const double cover = share(distance, radius);
      if (cover >= entry.cover) return;
      entry.cover = cover;
      entry.cell = cell;
    };
    scheme.for_each_cell_within(focus.position, widest, reach);
  });
}

// Fills wanted_ with the groups to hold, nearest first, cut at the cap.
void Subscription::choose(std::chrono::nanoseconds now) {
  wanted_.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    const bool stay = entry.joined && (entry.reach <= config_.leave_factor ||
                                       now - entry.since < config_.minimum_stay);
    if (entry.reach <= 0.6) wanted_.push_back(static_cast<std::uint16_t>(i));
  }
  if (wanted_.size() <= config_.maximum_groups) return;

  // Over the cap a joined group counts as nearer, so that two at equal distance do not alternate.
  const auto rank = [this](std::uint16_t index) {
    const Entry& entry = entries_[index];
    return entry.joined ? entry.reach / config_.leave_factor : entry.reach;
  };
  std::sort(wanted_.begin(), wanted_.end(), [&](std::uint16_t a, std::uint16_t b) {
    const double rank_a = rank(a), rank_b = rank(b);
    return rank_a < rank_b || (rank_a == rank_b && a < b);
  });
}

SubscriptionChange Subscription::apply(std::chrono::nanoseconds now) {
  SubscriptionChange change;
  const std::size_t kept = std::min(wanted_.size(), config_.maximum_groups);
  for (std::size_t i = kept; i < wanted_.size(); ++i) {
    const Entry& entry = entries_[wanted_[i]];
    if (entry.reach > 1.0) continue;  // only lingering
    ++change.uncovered;
    change.covered_share = std::min(change.covered_share, entry.cover);
  }
  std::sort(wanted_.begin(), wanted_.begin() + static_cast<std::ptrdiff_t>(kept));

  join_.clear();
  leave_.clear();
  joined_.clear();
  std::size_t next = 0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    Entry& entry = entries_[i];
    const bool hold = next < kept && wanted_[next] == i;
    if (hold) ++next;
    const GroupIndex group{static_cast<std::uint16_t>(i + 1)};
    if (hold && !entry.joined) {
      entry.since = now;
      join_.push_back(group);
    } else if (!hold && entry.joined) {
      leave_.push_back(group);
    }
    entry.joined = hold;
    if (hold) joined_.push_back(group);
  }
  change.join = join_;
  change.leave = leave_;
  return change;
}

}  // namespace reckon::aoim

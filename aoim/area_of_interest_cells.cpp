// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manager's cells: which of them we listen to, by which groups, and who is asked when we come.
#include <algorithm>
#include <array>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/aoim/interest/near_rows.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kCellSize = pdu::kFixedSize<pdu::CellIndex>;

}  // namespace

// As far as the tier reaches beyond the foci, or less far.
std::span<const Focus> AreaOfInterestManager::foci_of(std::size_t tier,
                                                      std::span<const Focus> foci) {
  const bool is_wide = tier == kCellTier && config_.farthest_nimbus > 0.0;
  if (!is_wide && !tiers_.is_near(tier)) return foci;
  tier_foci_.assign(foci.begin(), foci.end());
  for (Focus& focus : tier_foci_) {
    if (is_wide)
      focus.radius += config_.farthest_nimbus;
    else
      focus = near_focus(channels_->table(), tiers_.row_of(tier), focus, config_.radius, stretch_);
  }
  return tier_foci_;
}

SubscriptionChange AreaOfInterestManager::listen(std::size_t tier, std::span<const Focus> foci,
                                                 nanoseconds now) {
  if (tier == kCellTier) return listen_to_cells(foci, now);
  if (tier >= tiers_.count()) return {};
  Subscription& subscription = subscriptions_[tier];
  const SubscriptionChange change = subscription.update(foci_of(tier, foci), now);
  join_.clear();
  leave_.clear();
  for (const GroupIndex cell : change.join) {
    join_.push_back(tiers_.group(tier, cell));
    if (started_ && tiers_.is_near(tier)) ask_owners(tier, subscription.cell(cell));
  }
  for (const GroupIndex cell : change.leave) leave_.push_back(tiers_.group(tier, cell));
  for (const GroupIndex group : join_) sequences_.forget(group);
  for (const GroupIndex group : leave_) sequences_.forget(group);
  return {join_, leave_, change.uncovered, change.covered_share};
}

SubscriptionChange AreaOfInterestManager::listen_to_cells(std::span<const Focus> foci,
                                                          nanoseconds now) {
  sight_.set_foci(foci);
  if (config_.interop) return {};
  Subscription& subscription = subscriptions_.front();
  const auto besides = sight_.follow(now, config_.leader.empty, [&](std::uint32_t tag) {
    return leading_->role().directory().find_beacon(tag, now);
  });
  SubscriptionChange change = subscription.update(foci_of(kCellTier, foci), now, besides);
  if (!change.leave.empty()) sight_.leave_locale();
  if (!hands_out()) {
    for (const GroupIndex group : change.leave) asks_.leave(group);
  }
  if (leading_) {
    change = leading_->follow(change, now + utc_offset_, now);
  } else {  // whoever receives our start introduces everything
    for (const GroupIndex group : change.join)
      asks_.join(group, subscription.cell(group), started_, now);
  }
  for (const GroupIndex group : change.leave) sequences_.forget(group);
  for (const GroupIndex group : change.join) sequences_.forget(group);
  return change;
}

void AreaOfInterestManager::ask_owners(std::size_t tier, CellId cell) {
  std::array<std::byte, kCellSize> octets;
  if (pdu::store_record(pdu::CellIndex{cell.q, cell.r}, octets) == 0) return;
  joined_[tier].insert(joined_[tier].end(), octets.begin(), octets.end());
}

bool AreaOfInterestManager::hears(GroupIndex group) const noexcept {
  if (group == kBaseGroup) return true;
  if (hands_out()) return leading_->has_joined(group);
  return subscriptions_[tiers_.tier_of(group)].is_joined(tiers_.cell_of(group));
}

std::size_t AreaOfInterestManager::joined_groups() const noexcept {
  if (hands_out()) return leading_->joined_groups();
  std::size_t count = 0;
  for (const Subscription& tier : subscriptions_) count += tier.joined().size();
  return count;
}

// Who joins a cell has not heard its entities yet. What is asked again of us is known by its
// instant.
void AreaOfInterestManager::note_membership(const pdu::CellMembership& membership, nanoseconds now,
                                            const SourceAddress& from) {
  if (membership.header.exercise_id != presence_.own().header.exercise_id) return;
  const Standing standing = presence_.standing(membership.epoch, &from);
  if (standing != Standing::member && standing != Standing::unknown) return;
  // Who begins to listen to a near group knows what was sent to the rows behind it alone.
  const bool is_near = membership.action == pdu::MembershipAction::join_near;
  if (is_near && membership.near_row >= tiers_.near_rows()) return;
  if (!is_near && membership.action != pdu::MembershipAction::join) return;
  if (!is_near && !heard_asks_.note(membership.epoch, membership.since)) return;
  const std::size_t tier = is_near ? tiers_.of_row(membership.near_row) : kCellTier;
  const nanoseconds heard_for = presence_.heard_for(membership.epoch);
  for (const pdu::CellIndex& cell : pdu::records_of<pdu::CellIndex>(membership.cells)) {
    const CellId id{cell.column, cell.row};
    if (is_near || id != kWholeScene) {
      introductions_.begin(tiers_.group(tier, cells_.group(id)), heard_for, now);
    } else if (hands_out() && standing == Standing::member) {
      leading_->role().doubt_map(now);
      introductions_.begin(kBaseGroup, heard_for, now);
    }
  }
}

void AreaOfInterestManager::announce_memberships(nanoseconds now) {
  if (asks_.has_new()) ask_about_joins(false, now);
  for (std::size_t tier = 0; tier < tiers_.count(); ++tier) announce_membership(tier, now);
}

// With an announcement: what has to be asked again.
void AreaOfInterestManager::ask_about_joins(bool announcing, nanoseconds now) {
  const auto utc = static_cast<std::uint64_t>((now + utc_offset_).count());
  std::span<const JoinAsks::Question> rest = asks_.take_due(now, utc, announcing);
  while (!rest.empty()) {
    const auto other = std::ranges::find_if(
        rest, [&](const JoinAsks::Question& one) { return one.since != rest.front().since; });
    const auto count =
        std::min<std::size_t>(static_cast<std::size_t>(other - rest.begin()), JoinAsks::kMostCells);
    std::array<std::byte, JoinAsks::kMostCells * kCellSize> cells;
    for (std::size_t i = 0; i < count; ++i) {
      const CellId cell = rest[i].cell;
      static_cast<void>(pdu::store_record(pdu::CellIndex{cell.q, cell.r},
                                          std::span(cells).subspan(i * kCellSize, kCellSize)));
    }
    pdu::CellMembership membership;
    membership.action = pdu::MembershipAction::join;
    membership.since = rest.front().since;
    membership.cells = std::span(cells).first(count * kCellSize);
    add_membership(membership, now);
    rest = rest.subspan(count);
  }
  presence_.announce_by(asks_.next_repetition());
}

// Says it of the cells joined in this tier, of which none are left.
void AreaOfInterestManager::announce_membership(std::size_t tier, nanoseconds now) {
  std::uint64_t announced = 0;  // makes questions of one instant differ
  std::span<const std::byte> rest(joined_[tier]);
  while (!rest.empty()) {
    const auto cells = rest.first(std::min(rest.size(), JoinAsks::kMostCells * kCellSize));
    rest = rest.subspan(cells.size());
    pdu::CellMembership membership;
    if (tiers_.is_near(tier)) {
      membership.action = pdu::MembershipAction::join_near;
      membership.near_row = static_cast<std::uint8_t>(tiers_.row_of(tier));
    } else {
      membership.action = pdu::MembershipAction::join;
    }
    membership.since = static_cast<std::uint64_t>((now + utc_offset_).count()) + announced++;
    membership.cells = cells;
    add_membership(membership, now);
  }
  joined_[tier].clear();
}

void AreaOfInterestManager::add_membership(pdu::CellMembership membership, nanoseconds now) {
  membership.header.exercise_id = presence_.own().header.exercise_id;
  membership.header.timestamp = pdu::to_dis_timestamp(now + utc_offset_, synchronised_);
  membership.simulation = presence_.id();
  membership.epoch = presence_.own().epoch;
  std::array<std::byte, 32 + JoinAsks::kMostCells * kCellSize> octets;
  const std::size_t size = pdu::encode(membership, octets);
  aggregator_.add(kBaseGroup, std::span(octets).first(size), now);
}

}  // namespace reckon::aoim

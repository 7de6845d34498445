// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/viewer/history/received_groups.hpp"

#include "reckon/pdu/reckon/cell_roles.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr std::array<GroupTier, 2> kTiers{GroupTier::near, GroupTier::contact};

}  // namespace

void ReceivedGroups::note_update(std::uint16_t slot, const peer::GroupAddress& group,
                                 nanoseconds time) {
  const TieredGroup found = tiers_.of(group);
  if (found.number == 0) return;
  if (slot >= slots_.size()) slots_.resize(slot + std::size_t{1});
  slots_[slot][found.tier == kTiers[1] ? 1 : 0] = {found.number, time};
}

void ReceivedGroups::take_roles(std::span<const std::byte> pdu, nanoseconds time) {
  pdu::CellRoles roles;
  if (decode(pdu, roles) != pdu::DecodeError::none) return;
  for (const pdu::CellRole& role : pdu::records_of<pdu::CellRole>(roles.roles)) {
    if (role.beacon == 0) continue;
    if ((role.flags & pdu::kRoleLeaves) != 0) {
      const auto known = beacons_.find(role.beacon);
      if (known != beacons_.end() && known->second.cell == pdu::CellIndex{role.column, role.row})
        beacons_.erase(known);
      continue;
    }
    if (beacons_.size() >= kMostBeacons && !beacons_.contains(role.beacon))
      std::erase_if(beacons_,
                    [time](const auto& row) { return time - row.second.received > kBeaconKept; });
    if (beacons_.size() < kMostBeacons || beacons_.contains(role.beacon))
      beacons_[role.beacon] = {{role.column, role.row}, roles.simulation, time};
  }
}

std::vector<SharedGroup> ReceivedGroups::shared_at(nanoseconds time) const {
  std::map<std::uint16_t, SharedGroup> shared;
  for (std::size_t slot = 0; slot < slots_.size(); ++slot) {
    for (std::size_t tier = 0; tier < kTiers.size(); ++tier) {
      const Carried& carried = slots_[slot][tier];
      if (carried.number == 0 || time - carried.time > kLately) continue;
      SharedGroup& group = shared[carried.number];
      group.group = {kTiers[tier], carried.number};
      group.slots.push_back(static_cast<std::uint16_t>(slot));
    }
  }
  std::vector<SharedGroup> out;
  for (auto& [number, group] : shared) out.push_back(std::move(group));
  return out;
}

std::size_t ReceivedGroups::weight() const noexcept {
  constexpr std::size_t kNode = 80;
  return slots_.size() * sizeof(Tiers) + beacons_.size() * kNode;
}

}  // namespace reckon::tools

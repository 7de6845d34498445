// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// State in addition to the entities: the near or contact group by which each entity was last
// received, and the cell of each beacon.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/reckon/cell_membership.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/tools/viewer/history/group_tiers.hpp"

namespace reckon::tools {

/// Entities that a near or contact group has carried recently.
struct SharedGroup {
  TieredGroup group;
  std::vector<std::uint16_t> slots;  ///< ascending
};

struct ReceivedBeacon {
  pdu::CellIndex cell;
  pdu::SimulationAddress owner;
  std::chrono::nanoseconds received{};
};

/// A copy keeps the state of its instant. One thread. Accepts any octets; allocates for new slots
/// and beacons, within bounds.
class ReceivedGroups {
 public:
  /// An entity is listed under a group for this long after its last update there.
  static constexpr std::chrono::nanoseconds kLately = std::chrono::seconds(3);
  /// Owners send the cells of their beacons each second, or more often.
  static constexpr std::chrono::nanoseconds kBeaconKept = std::chrono::seconds(3);
  static constexpr std::size_t kMostBeacons = 256;

  explicit ReceivedGroups(const GroupTiers& tiers) : tiers_(tiers) {}

  /// Notes an update of the entity at a slot that this group carried.
  void note_update(std::uint16_t slot, const peer::GroupAddress& group,
                   std::chrono::nanoseconds time) {
    const TieredGroup found = tiers_.of(group);
    if (found.number == 0) return;
    if (slot >= slots_.size()) slots_.resize(slot + std::size_t{1});
    slots_[slot][found.tier == kTiers[1] ? 1 : 0] = {found.number, time};
  }
  /// Takes a Cell Roles PDU.
  void take_roles(std::span<const std::byte> pdu, std::chrono::nanoseconds time) {
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

  /// All groups that carried something within kLately before `time`, by number.
  [[nodiscard]] std::vector<SharedGroup> shared_at(std::chrono::nanoseconds time) const {
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
  /// By tag; the last report of some may be older than kBeaconKept.
  [[nodiscard]] const std::map<std::uint32_t, ReceivedBeacon>& beacons() const noexcept {
    return beacons_;
  }
  /// Octets, approximately.
  [[nodiscard]] std::size_t weight() const noexcept {
    constexpr std::size_t kNode = 80;
    return slots_.size() * sizeof(Tiers) + beacons_.size() * kNode;
  }

 private:
  static constexpr std::array<GroupTier, 2> kTiers{GroupTier::near, GroupTier::contact};

  struct Carried {
    std::uint16_t number = 0;  // 0: never
    std::chrono::nanoseconds time{};
  };
  using Tiers = std::array<Carried, 2>;  // last near group, last contact group

  GroupTiers tiers_;
  std::vector<Tiers> slots_;
  std::map<std::uint32_t, ReceivedBeacon> beacons_;  // by tag
};

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a listener receives beside states: which near or contact group brought updates of whom, and
// in which cell each beacon is.
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
#include "reckon/tools/viewer/history/group_tiers.hpp"

namespace reckon::tools {

/// Entities that one near or contact group has carried of late.
struct SharedGroup {
  TieredGroup group;
  std::vector<std::uint16_t> slots;  ///< ascending
};

struct ReceivedBeacon {
  pdu::CellIndex cell;
  pdu::SimulationAddress owner;
  std::chrono::nanoseconds received{};
};

/// A copy is what was known at that instant. One thread. Any octets will do; allocates for new
/// slots and beacons, within bounds.
class ReceivedGroups {
 public:
  /// A group that carried nothing of an entity for so long is not shown as its own.
  static constexpr std::chrono::nanoseconds kLately = std::chrono::seconds(3);
  /// Owners say each second, or more often, where their beacons are.
  static constexpr std::chrono::nanoseconds kBeaconKept = std::chrono::seconds(3);
  static constexpr std::size_t kMostBeacons = 256;

  explicit ReceivedGroups(const GroupTiers& tiers) : tiers_(tiers) {}

  /// An update of the entity at a slot came by this group.
  void note_update(std::uint16_t slot, const peer::GroupAddress& group,
                   std::chrono::nanoseconds time);
  /// A Cell Roles PDU.
  void take_roles(std::span<const std::byte> pdu, std::chrono::nanoseconds time);

  /// All that carried something within kLately before `time`, by number.
  [[nodiscard]] std::vector<SharedGroup> shared_at(std::chrono::nanoseconds time) const;
  /// By tag; the last report of some may be older than kBeaconKept.
  [[nodiscard]] const std::map<std::uint32_t, ReceivedBeacon>& beacons() const noexcept {
    return beacons_;
  }
  /// Octets, about.
  [[nodiscard]] std::size_t weight() const noexcept;

 private:
  struct Carried {
    std::uint16_t number = 0;  // 0: never
    std::chrono::nanoseconds time{};
  };
  using Tiers = std::array<Carried, 2>;  // by a near group, by a contact group

  GroupTiers tiers_;
  std::vector<Tiers> slots_;
  std::map<std::uint32_t, ReceivedBeacon> beacons_;  // by tag
};

}  // namespace reckon::tools

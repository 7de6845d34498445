// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manager's part in leading: what it hears of leaders, keeps for newcomers, and is told.
#include <algorithm>
#include <array>
#include <utility>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// What a leader tells of an owner that is not known is forgotten after so long.
constexpr std::chrono::seconds kOwnerAwaited{3};
// A bundle of ours leaves after so long at the latest.
constexpr std::chrono::seconds kLongestWait{1};

}  // namespace

// A state of ours, heard by the others when its bundle leaves.
void AreaOfInterestManager::note_state(GroupIndex group, const pdu::EntityState& state,
                                       std::span<const std::byte> records, nanoseconds deadline) {
  std::array<std::byte, StateStore::kLongest> octets;
  const std::size_t size = pdu::encode(state, octets);
  if (size == 0) return;
  const nanoseconds leaves = std::clamp(deadline, stepped_, stepped_ + kLongestWait);
  const std::uint32_t epoch = presence_.own().epoch;
  leader_->note(group, epoch, state, std::span(octets).first(size), leaves);
  leader_->note_records(epoch, state.entity_id, records);
}

// The force models in an Attribute PDU of a known peer.
void AreaOfInterestManager::note_attribute(std::span<const std::byte> octets,
                                           std::uint32_t sender) {
  pdu::Attribute attribute;
  if (pdu::decode(octets, attribute) != pdu::DecodeError::none) return;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    leader_->note_records(sender, set.entity_id, set.bytes);
  }
}

// The number under which a state that was heard in `group` is kept, that of its cell; the base
// group where it is none of ours.
GroupIndex AreaOfInterestManager::kept_as(GroupIndex group, const pdu::EntityState& state) const {
  if (!hands_out()) return group;
  const pdu::WorldCoordinates& at = state.location;
  const GroupIndex cell =
      cells_.group(config_.locate ? config_.locate(at) : Position{at.x, at.y, at.z});
  return subscription().is_joined(cell) ? cell : kBaseGroup;
}

// Of peers alone that are known, and each from its own address.
void AreaOfInterestManager::take_from_leaders(GroupIndex group, std::span<const std::byte> datagram,
                                              std::uint32_t sender, const SourceAddress& from,
                                              nanoseconds now, nanoseconds came) {
  if (presence_.standing(sender, &from) != Standing::member) return;
  // With the fixed tile no states of peers go to the base group.
  const bool is_kept = group != kBaseGroup || hands_out();
  const auto decodes = [](const pdu::BundledPdu& bundled, auto& pdu) {
    return pdu::decode(bundled.bytes, pdu) == pdu::DecodeError::none;
  };
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    if (bundled.error != pdu::DecodeError::none) continue;
    if (bundled.header.pdu_type == pdu::PduType::entity_state) {
      pdu::EntityState state;
      const bool counts = is_kept && decodes(bundled, state) &&
                          presence_.epoch_of(state.entity_id.simulation()) == sender;
      const GroupIndex number = counts ? kept_as(group, state) : kBaseGroup;
      if (number != kBaseGroup) {
        leader_->note(number, sender, state, bundled.bytes, now);
      } else if (counts) {  // it has gone to a cell that is none of ours
        leader_->forget(sender, state.entity_id);
      }
    } else if (bundled.header.pdu_type == pdu::PduType::attribute) {
      if (is_kept) note_attribute(bundled.bytes, sender);
    } else if (bundled.header.pdu_type == pdu::PduType::cell_roles) {
      pdu::CellRoles roles;
      if (decodes(bundled, roles)) leader_->receive(roles, sender, now);
    } else if (bundled.header.pdu_type == pdu::PduType::group_map) {
      pdu::GroupMap map;
      if (decodes(bundled, map)) leader_->receive(map, sender, now, std::min(came, now));
    } else if (bundled.header.pdu_type == pdu::PduType::cell_snapshot) {
      pdu::CellSnapshot part;
      if (decodes(bundled, part)) leader_->receive(part, sender, now);
    }
  }
}

std::vector<ToldState> AreaOfInterestManager::take_told(nanoseconds now) {
  std::vector<ToldState> taken;
  if (!leader_) return taken;
  for (ToldState& told : leader_->take_told()) told_.emplace_back(now, std::move(told));
  for (auto& [since, told] : told_) {
    if (presence_.standing(told.epoch) == Standing::member)
      taken.push_back(std::exchange(told, {}));
  }
  std::erase_if(told_, [now](const auto& waiting) {
    return waiting.second.octets.empty() || now - waiting.first > kOwnerAwaited;
  });
  return taken;
}

// Elections, maps and snapshots of ours; what no leader told in time is asked of the owners.
void AreaOfInterestManager::lead(nanoseconds now) {
  if (!leader_) return;
  stepped_ = now;
  if (std::exchange(leaves_cells_, false)) leader_->stop(now);
  const LeaderSignature signature{presence_.own().header.exercise_id,
                                  pdu::to_dis_timestamp(now + utc_offset_, synchronised_),
                                  presence_.id()};
  leader_->step(now, signature, [&](GroupIndex group, std::span<const std::byte> pdu) {
    aggregator_.add(group, pdu, now);
  });
  CellId cell;
  while (leader_->take_given_up(now, cell)) ask_owners(kCellTier, cell);
  if (leader_->take_plea(now)) ask_owners(kCellTier, kWholeScene);
}

}  // namespace reckon::aoim

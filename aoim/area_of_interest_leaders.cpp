// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The manager's part in leading: what it hears of leaders, keeps for newcomers, and is told.
#include <array>
#include <utility>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// What a leader tells of an owner that is not known is forgotten after so long.
constexpr std::chrono::seconds kOwnerAwaited{3};

}  // namespace

void AreaOfInterestManager::note_state(GroupIndex group, const pdu::EntityState& state) {
  std::array<std::byte, StateStore::kLongest> octets;
  const std::size_t size = pdu::encode(state, octets);
  if (size > 0) leader_->note(group, presence_.own().epoch, state, std::span(octets).first(size));
}

// Of peers alone that are known, and each from its own address.
void AreaOfInterestManager::take_from_leaders(GroupIndex group, std::span<const std::byte> datagram,
                                              std::uint32_t sender, const SourceAddress& from,
                                              nanoseconds now) {
  if (presence_.standing(sender, &from) != Standing::member) return;
  const auto decodes = [](const pdu::BundledPdu& bundled, auto& pdu) {
    return pdu::decode(bundled.bytes, pdu) == pdu::DecodeError::none;
  };
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    if (bundled.error != pdu::DecodeError::none) continue;
    if (bundled.header.pdu_type == pdu::PduType::entity_state) {
      pdu::EntityState state;
      const bool counts = group != kBaseGroup && decodes(bundled, state) &&
                          presence_.epoch_of(state.entity_id.simulation()) == sender;
      if (counts) leader_->note(group, sender, state, bundled.bytes);
    } else if (bundled.header.pdu_type == pdu::PduType::cell_roles) {
      pdu::CellRoles roles;
      if (decodes(bundled, roles)) leader_->receive(roles, sender, now);
    } else if (bundled.header.pdu_type == pdu::PduType::group_map) {
      pdu::GroupMap map;
      if (decodes(bundled, map)) leader_->receive(map, sender, now);
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
  if (std::exchange(leaves_cells_, false)) leader_->stop(now);
  const LeaderSignature signature{presence_.own().header.exercise_id,
                                  pdu::to_dis_timestamp(now + utc_offset_, synchronised_),
                                  presence_.id()};
  leader_->step(now, signature, [&](GroupIndex group, std::span<const std::byte> pdu) {
    aggregator_.add(group, pdu, now);
  });
  CellId cell;
  while (leader_->take_given_up(now, cell)) ask_owners(cell);
}

}  // namespace reckon::aoim

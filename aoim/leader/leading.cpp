// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/leading.hpp"

#include <algorithm>
#include <array>

#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/entity/attribute.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// Time for which relayed states of an unknown owner are kept.
constexpr std::chrono::seconds kOwnerAwaited{3};
// Longest wait before a bundle of ours is sent.
constexpr std::chrono::seconds kLongestWait{1};
// Time by which peers that were present have announced themselves to a newcomer.
constexpr std::chrono::milliseconds kIntroduced{150};

}  // namespace

Leading::Leading(const LeaderConfig& config, std::size_t pool, const CellPartition& cells,
                 const Subscription& subscription, const Presence& presence,
                 const BodyOwners* owners, Locate locate)
    : config_(config),
      cells_(cells),
      subscription_(subscription),
      presence_(presence),
      owners_(owners),
      locate_(std::move(locate)),
      role_(config, pool, presence.own().epoch) {
  if (!config.hand_out) return;
  handed_out_.resize(config.pool > 0 ? config.pool : pool);
  unread_.resize(cells_.groups());
  join_.reserve(handed_out_.size());
  leave_.reserve(handed_out_.size());
}

void Leading::start(nanoseconds utc, nanoseconds now) {
  started_ = true;
  begun_ = now;
  role_.start(utc, now);
}

// Groups of the subscribed cells, from the last map. A group that its cell has lost is left when no
// peer can use the old map any more.
SubscriptionChange Leading::follow(const SubscriptionChange& cells, nanoseconds utc,
                                   nanoseconds now) {
  for (const GroupIndex cell : cells.leave) role_.leave(cells_.cell_of(cell), now);
  for (const GroupIndex cell : cells.join) {
    role_.enter(cells_.cell_of(cell), cell, utc, now);
    if (hands_out()) unread_[cell.value - 1u] = true;
  }
  if (!hands_out()) return cells;
  // If maps were missed, others have sent in groups that we had not joined.
  const bool missed = role_.directory().pause() > config_.settle;
  join_.clear();
  leave_.clear();
  for (const GroupIndex cell : subscription_.joined()) {
    const auto group = role_.listen_group(cells_.cell_of(cell));
    if (!group) continue;
    HandedOut& handed = handed_out_[group->value - 1u];
    if (!handed.joined) {
      join_.push_back(*group);
      unread_[cell.value - 1u] = unread_[cell.value - 1u] || missed;
    }
    handed = {cell, now + config_.lease, true};
  }
  for (std::size_t i = 0; i < handed_out_.size(); ++i) {
    HandedOut& handed = handed_out_[i];
    const bool stays = now < handed.until && subscription_.is_joined(handed.cell);
    if (!handed.joined || stays) continue;
    handed.joined = false;
    leave_.push_back({static_cast<std::uint16_t>(i + 1)});
  }
  read_cells(now);
  return {join_, leave_, cells.uncovered, cells.covered_share};
}

// Requests the present states of newly joined cells from their leaders, once this peer has a map:
// without one it cannot receive the answers. If no peer announces a map for a heartbeat and a
// stagger after the start, it requests them without a map. During kIntroduced, a cell without a
// known leader is skipped.
void Leading::read_cells(nanoseconds now) {
  if (!started_ || role_.lacks_map(now)) return;
  const bool alone = now - begun_ > config_.heartbeat + config_.stagger;
  if (!alone && !role_.directory().holds(now)) return;
  for (const GroupIndex cell : subscription_.joined()) {
    const CellId id = cells_.cell_of(cell);
    const bool early = now - begun_ < kIntroduced && role_.leader(id) == 0;
    if (early || !unread_[cell.value - 1u]) continue;
    unread_[cell.value - 1u] = false;
    role_.read(id, now);
  }
}

// Records a state of ours. The others receive it when its bundle is sent.
void Leading::note_own(GroupIndex cell, const pdu::EntityState& state,
                       std::span<const std::byte> records, nanoseconds deadline) {
  std::array<std::byte, StateStore::kLongest> octets;
  const std::size_t size = pdu::encode(state, octets);
  if (size == 0) return;
  const nanoseconds leaves = std::clamp(deadline, stepped_, stepped_ + kLongestWait);
  const std::uint32_t epoch = presence_.own().epoch;
  role_.note(cell, epoch, state, std::span(octets).first(size), leaves);
  role_.note_records(epoch, state.entity_id, records);
}

bool Leading::owns(std::uint32_t sender, const pdu::EntityId& entity) const noexcept {
  if (owners_ != nullptr && BodyOwners::are_for(entity)) return owners_->of(entity).epoch == sender;
  return presence_.epoch_of(entity.simulation()) == sender;
}

// The records in an Attribute PDU of a known peer.
void Leading::note_attribute(std::span<const std::byte> octets, std::uint32_t sender) {
  pdu::Attribute attribute;
  if (pdu::decode(octets, attribute) != pdu::DecodeError::none) return;
  for (const pdu::AttributeSet& set : pdu::AttributeReader(attribute)) {
    role_.note_records(sender, set.entity_id, set.bytes);
  }
}

// The number under which a state is kept, whatever the group in which it is received: its cell's
// number, or the base group if the cell is not ours.
GroupIndex Leading::kept_as(const pdu::EntityState& state) const {
  const pdu::WorldCoordinates& at = state.location;
  const GroupIndex cell = cells_.group(locate_ ? locate_(at) : Position{at.x, at.y, at.z});
  return subscription_.is_joined(cell) ? cell : kBaseGroup;
}

void Leading::receive(GroupIndex group, std::span<const std::byte> datagram, std::uint32_t sender,
                      nanoseconds now, nanoseconds came) {
  // With the fixed tile, peers send no states to the base group.
  const bool is_kept = group != kBaseGroup || hands_out();
  const auto decodes = [](const pdu::BundledPdu& bundled, auto& pdu) {
    return pdu::decode(bundled.bytes, pdu) == pdu::DecodeError::none;
  };
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
    if (bundled.error != pdu::DecodeError::none) continue;
    if (bundled.header.pdu_type == pdu::PduType::entity_state) {
      pdu::EntityState state;
      const bool counts = is_kept && decodes(bundled, state) && owns(sender, state.entity_id);
      const GroupIndex number = counts ? kept_as(state) : kBaseGroup;
      if (number != kBaseGroup) {
        role_.note(number, sender, state, bundled.bytes, now);
      } else if (counts) {  // it has moved to a cell that is not ours
        role_.forget(sender, state.entity_id);
      }
    } else if (bundled.header.pdu_type == pdu::PduType::attribute) {
      if (is_kept) note_attribute(bundled.bytes, sender);
    } else if (bundled.header.pdu_type == pdu::PduType::cell_roles) {
      pdu::CellRoles roles;
      if (decodes(bundled, roles)) role_.receive(roles, sender, now);
    } else if (bundled.header.pdu_type == pdu::PduType::group_map) {
      pdu::GroupMap map;
      if (decodes(bundled, map)) role_.receive(map, sender, now, std::min(came, now));
    } else if (bundled.header.pdu_type == pdu::PduType::cell_snapshot) {
      pdu::CellSnapshot part;
      if (decodes(bundled, part)) role_.receive(part, sender, now);
    }
  }
}

std::vector<RelayedState> Leading::take_relayed(nanoseconds now) {
  std::vector<RelayedState> taken;
  for (RelayedState& relayed : role_.take_relayed()) relayed_.emplace_back(now, std::move(relayed));
  for (auto& [since, relayed] : relayed_) {
    if (presence_.standing(relayed.epoch) == Standing::member)
      taken.push_back(std::exchange(relayed, {}));
  }
  std::erase_if(relayed_, [now](const auto& waiting) {
    return waiting.second.octets.empty() || now - waiting.first > kOwnerAwaited;
  });
  return taken;
}

// States that no leader relayed in time are requested from the owners: see
// LeaderRole::take_given_up.
void Leading::step(nanoseconds now, std::uint32_t timestamp, const LeaderRole::Send& send) {
  stepped_ = now;
  if (std::exchange(leaves_cells_, false)) role_.stop(now);
  role_.step(now, {presence_.own().header.exercise_id, timestamp, presence_.id()}, send);
}

void Leading::set_beacons(std::span<const PlacedBeacon> beacons, nanoseconds now) {
  if (!hands_out()) return;
  carried_.clear();
  for (const PlacedBeacon& beacon : beacons)
    carried_.push_back({beacon.tag, cells_.cell_of(cells_.group(beacon.position))});
  role_.set_beacons(carried_, now);
}

std::optional<CellId> Leading::carried_in(std::uint32_t tag) const noexcept {
  const auto found = std::find_if(carried_.begin(), carried_.end(),
                                  [tag](const CarriedBeacon& one) { return one.tag == tag; });
  if (found == carried_.end()) return {};
  return found->cell;
}

}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/leader_role.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "reckon/pdu/codec/record_range.hpp"
#include "reckon/pdu/entity/attribute.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kRolesPerPdu = 25, kRoleSize = pdu::kFixedSize<pdu::CellRole>;
constexpr std::size_t kKeptRecords = 2;  // of an entity, at most: see StateStore
constexpr std::size_t kMostPopulated = 4096;
constexpr std::size_t kMostTold = 65'536;
// A former leader of the scene sends its map this many times more. The new leader merges it. One
// copy is not enough after a partition: it may be lost, or arrive before the new leader has
// accepted us.
constexpr int kLastMaps = 3;

void read_records(std::span<const std::byte> records, RelayedState& relayed) {
  pdu::AttributeRecordCursor cursor(kKeptRecords, records);
  pdu::AttributeRecord record;
  while (cursor.next(record)) {
    pdu::HapticRecord model;
    pdu::OwnershipRecord ownership;
    if (pdu::decode(record, model) == pdu::DecodeError::none) relayed.model = model;
    if (pdu::decode(record, ownership) == pdu::DecodeError::none) relayed.ownership = ownership;
  }
}

}  // namespace

LeaderRole::LeaderRole(const LeaderConfig& config, std::size_t pool, std::uint32_t epoch)
    : config_(config),
      groups_(config.pool > 0 ? config.pool : pool),
      leadership_(config, epoch),
      pool_(groups_, config.quarantine),
      directory_(groups_, config.lease),
      rival_(groups_, config.lease),
      server_(config),
      reader_(config),
      beacons_(config.empty) {
  if (config.quarantine <= config.lease) {
    throw std::invalid_argument(
        "the quarantine of groups must be longer than the lease of their map: use three times the "
        "lease");
  }
}

void LeaderRole::start(nanoseconds utc, nanoseconds now) {
  leadership_.enter(kWholeScene, utc, now);
  next_plea_ = now + config_.give_up;
}

void LeaderRole::stop(nanoseconds now) {
  for (const auto& [cell, group] : entered_) leadership_.leave(cell, now);
  leadership_.leave(kWholeScene, now);
  entered_.clear();
}

void LeaderRole::enter(CellId cell, GroupIndex group, nanoseconds utc, nanoseconds now) {
  if (!leadership_.enter(cell, utc, now)) return;
  entered_[cell] = group;
  if (!config_.hand_out) reader_.begin(cell, now);
  leadership_.say_soon(cell, now);
}

void LeaderRole::read(CellId cell, nanoseconds now) {
  if (leads(cell) && !leadership_.had_other_leader(cell)) return;
  reader_.begin(cell, now);
  if (leads(cell)) return reader_.give_up(cell, now);  // a new leader asks the owners
  leadership_.say_soon(cell, now);
}

bool LeaderRole::take_plea(nanoseconds now) noexcept {
  if (!lacks_map(now) || now < next_plea_) return false;
  next_plea_ = now + config_.refresh;
  return true;
}

GroupIndex LeaderRole::speak_group(CellId cell, nanoseconds now) const noexcept {
  if (now - doubted_ < config_.settle) return kBaseGroup;
  return directory_.settled_group(cell, config_.settle, now).value_or(kBaseGroup);
}

void LeaderRole::leave(CellId cell, nanoseconds now) {
  const auto entered = entered_.find(cell);
  if (entered == entered_.end()) return;
  states_.forget(entered->second);
  entered_.erase(entered);
  leadership_.leave(cell, now);
  reader_.drop(cell);
  server_.drop(cell);
}

void LeaderRole::set_beacons(std::span<const CarriedBeacon> beacons, nanoseconds now) {
  if (std::equal(beacons.begin(), beacons.end(), carried_.begin(), carried_.end())) return;
  for (const CarriedBeacon& beacon : beacons) {
    if (std::find(carried_.begin(), carried_.end(), beacon) == carried_.end())
      leadership_.say_soon(beacon.cell, now);
  }
  carried_.assign(beacons.begin(), beacons.end());
  next_hand_out_ = now;
}

// ------------------------------------------------------------------------------------- receiving

void LeaderRole::receive(const pdu::CellRoles& roles, std::uint32_t sender, nanoseconds now) {
  if (roles.epoch != sender || sender == leadership_.epoch()) return;
  for (const pdu::CellRole& role : pdu::records_of<pdu::CellRole>(roles.roles)) {
    const CellId cell{role.column, role.row};
    const bool leaves = (role.flags & pdu::kRoleLeaves) != 0;
    if (cell != kWholeScene && !leaves) {
      note_populated(cell, now);
      changed_ |= beacons_.receive(role.beacon, cell, sender, now);
    } else if (leaves) {
      changed_ |= beacons_.leave(cell, sender);
    }
    if (cell == kWholeScene) {
      heard_mapped_ |= (role.flags & pdu::kRoleMapped) != 0;
      // After a partition two leaders have different maps until one of them gives way.
      const bool rivals = (role.flags & pdu::kRoleLeads) != 0 && !leaves &&
                          sender != leader(cell) && leadership_.is_led(cell, now);
      if (rivals) doubted_ = now;
    }
    leadership_.receive(role, sender, now);
    if ((role.flags & pdu::kRoleAsks) != 0 && !leaves) answer(role, now);
  }
}

// Answers a peer that lacks the states of a cell. For the whole scene, it lacks the map.
void LeaderRole::answer(const pdu::CellRole& role, nanoseconds now) {
  const CellId cell{role.column, role.row};
  if (!leads(cell)) return;
  if (cell == kWholeScene) {
    next_map_ = std::min(next_map_, std::max(now, last_map_ + kMapGap));
    return;
  }
  const auto entered = entered_.find(cell);
  if (entered == entered_.end()) return;
  const GroupIndex number = entered->second;
  const GroupIndex group =
      config_.hand_out ? directory_.last_group(cell).value_or(kBaseGroup) : number;
  server_.ask(role, number, group, now);
  leadership_.say_soon(cell, now);
}

void LeaderRole::note_populated(CellId cell, nanoseconds now) {
  if (populated_.size() >= kMostPopulated && populated_.count(cell) == 0) return;
  populated_[cell] = now;
}

void LeaderRole::receive(const pdu::GroupMap& part, std::uint32_t sender, nanoseconds now,
                         nanoseconds came) {
  if (part.epoch != sender || sender == leadership_.epoch()) return;
  if (!leads(kWholeScene)) {
    if (sender == leader(kWholeScene)) directory_.receive(part, sender, came);
    return;
  }
  // A leader that will give way merges nothing. Otherwise its last map would list groups that only
  // the other leader uses as resting.
  if (!leadership_.came_later(kWholeScene, sender)) return;
  if (!rival_.receive(part, sender, now)) return;
  pool_.merge(rival_.entries(), now);
  pool_.merge(rival_.resting(), now);
  version_ = std::max(version_, rival_.version());
  changed_ = true;
}

void LeaderRole::receive(const pdu::CellSnapshot& part, std::uint32_t sender, nanoseconds now) {
  const CellId cell{part.column, part.row};
  const auto entered = entered_.find(cell);
  if (part.epoch != sender || entered == entered_.end() || sender != leader(cell)) return;
  if (!reader_.receive(part, sender, now)) return;
  std::span<const std::byte> rest = part.states.bytes;
  pdu::SnapshotState head;
  while (pdu::load_record(rest, head)) {
    rest = rest.subspan(pdu::kFixedSize<pdu::SnapshotState>);
    if (head.length > rest.size()) return;
    take_state(head, rest.first(head.length), entered->second, now);
    rest = rest.subspan(head.length);
  }
}

void LeaderRole::take_state(const pdu::SnapshotState& head, std::span<const std::byte> octets,
                            GroupIndex group, nanoseconds now) {
  pdu::EntityState state;
  if (pdu::decode(octets, state) != pdu::DecodeError::none) return;
  if (head.epoch == leadership_.epoch() || relayed_.size() >= kMostTold) return;
  const nanoseconds heard = now - head.age * std::chrono::milliseconds(10);
  const auto records = octets.subspan(state.header.length);
  octets = octets.first(state.header.length);
  states_.note_if_new(group, head.epoch, state, octets, heard);
  states_.note_records(head.epoch, state.entity_id, records);
  RelayedState relayed{head.epoch, {octets.begin(), octets.end()}, {}, heard};
  read_records(records, relayed);
  relayed_.push_back(std::move(relayed));
}

void LeaderRole::forget(std::uint32_t epoch, nanoseconds now) {
  changed_ |= beacons_.forget(epoch);
  leadership_.forget(epoch, now);
  states_.forget(epoch);
}

// --------------------------------------------------------------------------------------- sending

void LeaderRole::step(nanoseconds now, const LeaderSignature& signature, const Send& send) {
  leadership_.step(now);
  take_events(now);
  reader_.for_each_due(now, [&](CellId cell) { leadership_.say_soon(cell, now); });
  if (lacks_map(now) && now >= next_map_ask_) {
    next_map_ask_ = now + config_.ask_again;
    leadership_.say_soon(kWholeScene, now);
  }
  say_roles(now, signature, send);
  if (leads(kWholeScene)) {
    hand_out(now);
    const bool due = changed_ ? now >= last_map_ + kMapGap : now >= next_map_;
    if (due) publish(now, signature, send);
  } else if (last_maps_ > 0 && now >= next_map_) {
    publish(now, signature, send);
    --last_maps_;
    next_map_ = now + config_.heartbeat;
  }
  server_.step(now, states_, [&](GroupIndex group, pdu::CellSnapshot& part) {
    sign(part, signature);
    std::array<std::byte, pdu::kFixedSize<pdu::CellSnapshot> + SnapshotServer::kMostOctets> octets;
    send(group, std::span(octets).first(pdu::encode(part, octets)));
  });
}

void LeaderRole::take_events(nanoseconds now) {
  for (const LeaderEvent& event : leadership_.take_events()) {
    if (event.ours) {
      // The former leader may have left in the middle of a snapshot. Then we ask the owners.
      leadership_.had_other_leader(event.cell) ? reader_.give_up(event.cell, now)
                                               : reader_.drop(event.cell);
    }
    if (event.lost) server_.drop(event.cell);
    if (event.cell != kWholeScene) continue;
    // After a suspend without the lead there is no map to send: its lease is over, or it is the
    // same as the new leader's.
    if (event.lost && event.leader != 0) {
      last_maps_ = kLastMaps;
      next_map_ = now;
    }
    if (!event.ours) continue;
    last_maps_ = 0;
    const bool fresh =
        !heard_mapped_ && directory_.leader() == 0 && !leadership_.had_other_leader(kWholeScene);
    // A map whose lease is over may name groups that other cells have by now.
    const auto map =
        directory_.holds(now) ? directory_.entries() : std::span<const pdu::CellGroup>();
    pool_.begin(map, fresh, now);
    version_ = std::max(version_, directory_.version());  // some peers may have ours already
    changed_ = true;
    next_hand_out_ = now;
    // Peers that we have not received yet use these groups, so they are not given back.
    for (const pdu::CellGroup& entry : map) note_populated({entry.column, entry.row}, now);
  }
}

void LeaderRole::say_roles(nanoseconds now, const LeaderSignature& signature, const Send& send) {
  pdu::CellRole role;
  while (leadership_.take_role(now, role)) {
    const CellId cell{role.column, role.row};
    if (cell == kWholeScene && directory_.leader() != 0) role.flags |= pdu::kRoleMapped;
    const bool asks = cell == kWholeScene && config_.hand_out && !leads(cell);
    if (asks && !directory_.holds(now)) role.flags |= pdu::kRoleAsks;
    std::size_t next = 0;
    const bool leaves = (role.flags & pdu::kRoleLeaves) != 0;
    for (const CarriedBeacon& beacon : carried_) {
      if (leaves || beacon.cell != cell) continue;
      if (role.beacon != 0) add_role(role, signature, send);
      role.beacon = beacon.tag;
    }
    for (int windows = 0; windows < 4; ++windows) {
      next = leaves || leads(cell) ? 0 : reader_.fill(role, next, now);
      add_role(role, signature, send);
      if (next == 0) break;
    }
  }
  send_roles(signature, send);
}

void LeaderRole::add_role(const pdu::CellRole& role, const LeaderSignature& signature,
                          const Send& send) {
  std::array<std::byte, kRoleSize> octets;
  static_cast<void>(pdu::store_record(role, octets));
  roles_.insert(roles_.end(), octets.begin(), octets.end());
  if (roles_.size() == kRolesPerPdu * kRoleSize) send_roles(signature, send);
}

void LeaderRole::send_roles(const LeaderSignature& signature, const Send& send) {
  if (roles_.empty()) return;
  pdu::CellRoles roles;
  sign(roles, signature);
  roles.roles = roles_;
  std::array<std::byte, pdu::kFixedSize<pdu::CellRoles> + kRolesPerPdu * kRoleSize> octets;
  send(kBaseGroup, std::span(octets).first(pdu::encode(roles, octets)));
  roles_.clear();
}

}  // namespace reckon::aoim

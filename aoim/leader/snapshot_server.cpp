// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/leader/snapshot_server.hpp"

#include <algorithm>
#include <array>

namespace reckon::aoim {
namespace {

constexpr double kEntityOctets = 208.0;  // size of an entity with a force model
constexpr std::size_t kHead = pdu::kFixedSize<pdu::SnapshotState>;

std::size_t size_of(const StateStore::Entry& entry) noexcept {
  return entry.octets.size() + entry.records.size();
}

// Rounded down: a state received later than this age shows seems to have been under way for less.
std::uint16_t age_of(const StateStore::Entry& entry, std::chrono::nanoseconds now) noexcept {
  const auto age = (now - entry.heard) / std::chrono::milliseconds(10);
  return static_cast<std::uint16_t>(std::clamp<std::int64_t>(age, 0, 0xFFFF));
}

}  // namespace

using std::chrono::nanoseconds;

void SnapshotServer::ask(const pdu::CellRole& role, GroupIndex number, GroupIndex group,
                         nanoseconds now) {
  const CellId cell{role.column, role.row};
  auto found = std::find_if(snapshots_.begin(), snapshots_.end(),
                            [cell](const Snapshot& snapshot) { return snapshot.cell == cell; });
  if (found == snapshots_.end()) {
    snapshots_.emplace_back();
    found = std::prev(snapshots_.end());
    found->cell = cell;
  }
  Snapshot& snapshot = *found;
  snapshot.number = number;
  snapshot.group = group;
  if (role.serial == 0 || role.serial != snapshot.serial) {
    // A running snapshot is enough: the newcomer requests the parts that it missed.
    if (snapshot.asked || snapshot.due.left() > 0) return;
    snapshot.asked = true;
    snapshot.begin_at = now + config_.collect;
    return;
  }
  snapshot.due.request({role.first_part, role.parts});
  snapshot.next = std::max(snapshot.next, now);
}

void SnapshotServer::drop(CellId cell) {
  std::erase_if(snapshots_, [cell](const Snapshot& snapshot) { return snapshot.cell == cell; });
}

void SnapshotServer::begin_if_due(Snapshot& snapshot, nanoseconds now, const StateStore& states) {
  if (!snapshot.asked || now < snapshot.begin_at) return;
  budget_.set_whole(static_cast<double>(states.size()) * kEntityOctets);
  snapshot.begin_at = std::max(snapshot.begin_at, budget_.ready_at());
  if (now < snapshot.begin_at) return;
  snapshot.asked = false;
  snapshot.serial = static_cast<std::uint16_t>(snapshot.serial == 0xFFFF ? 1 : snapshot.serial + 1);
  snapshot.parts.assign(1, {});
  std::size_t filled = 0;
  for (const pdu::EntityId& entity : states.entities(snapshot.number)) {
    const std::size_t size = kHead + size_of(*states.find(entity));
    if (filled + size > kMostOctets) {
      if (snapshot.parts.size() == kMostParts) break;
      snapshot.parts.emplace_back();
      filled = 0;
    }
    filled += size;
    snapshot.parts.back().push_back(entity);
  }
  snapshot.due.begin(snapshot.parts.size());
  snapshot.next = now;
}

// Leaves out an entity that has gone meanwhile or has grown too long for its part.
bool SnapshotServer::take_part(Snapshot& snapshot, nanoseconds now, const StateStore& states,
                               pdu::CellSnapshot& part) {
  if (snapshot.due.left() == 0 || now < snapshot.next) return false;
  snapshot.next = std::max(snapshot.next, budget_.ready_at());
  if (now < snapshot.next) return false;
  const std::size_t index = snapshot.due.take();
  snapshot.next += config_.part_gap;
  octets_.clear();
  for (const pdu::EntityId& entity : snapshot.parts[index]) {
    const StateStore::Entry* entry = states.find(entity);
    if (entry == nullptr || octets_.size() + kHead + size_of(*entry) > kMostOctets) continue;
    std::array<std::byte, kHead> head;
    const pdu::SnapshotState state{entry->epoch, static_cast<std::uint16_t>(size_of(*entry)),
                                   age_of(*entry, now)};
    static_cast<void>(pdu::store_record(state, head));
    octets_.insert(octets_.end(), head.begin(), head.end());
    octets_.insert(octets_.end(), entry->octets.begin(), entry->octets.end());
    octets_.insert(octets_.end(), entry->records.begin(), entry->records.end());
  }
  part = {};
  part.column = snapshot.cell.q;
  part.row = snapshot.cell.r;
  part.serial = snapshot.serial;
  part.part = static_cast<std::uint16_t>(index);
  part.parts = static_cast<std::uint16_t>(snapshot.parts.size());
  part.states = pdu::OctetBlock<std::uint16_t>::of(octets_);
  budget_.spend(octets_.size(), now);
  ++parts_sent_;
  return true;
}

nanoseconds SnapshotServer::next_step() const noexcept {
  nanoseconds next = nanoseconds::max();
  for (const Snapshot& snapshot : snapshots_) {
    if (snapshot.asked) next = std::min(next, snapshot.begin_at);
    if (snapshot.due.left() > 0) next = std::min(next, snapshot.next);
  }
  return next;
}

}  // namespace reckon::aoim

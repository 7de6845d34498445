// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/object_rows.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;
using Hold = ObjectRow::Hold;
using Row = ObjectRow;

}  // namespace

bool ObjectRows::owns(std::size_t object, nanoseconds now) const noexcept {
  const Row& row = rows_[object];
  return row.hold == Hold::owned && (row.confirmed || now < row.until);
}

ObjectSet ObjectRows::held() const noexcept {
  ObjectSet held;
  for (std::size_t i = 0; i < core_.table.size(); ++i) held[i] = holds(i);
  return held;
}

bool ObjectRows::is_granting() const noexcept {
  return std::ranges::any_of(rows_, [](const Row& row) { return row.hold == Hold::granting; });
}

bool ObjectRows::is_busy() const noexcept {
  return std::ranges::any_of(std::span(rows_).first(core_.table.size()), [](const Row& row) {
    const bool unsettled = row.hold != Hold::none && (row.hold != Hold::owned || !row.confirmed);
    return unsettled || (row.wanted && row.hold == Hold::none) || row.askers[0].epoch != 0;
  });
}

void ObjectRows::gain(const ObjectSet& objects, OwnerChange cause) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!objects[i]) continue;
    Row& row = rows_[i];
    row.hold = Hold::owned;
    row.confirmed = true;
    row.askers = {};
  }
  core_.report({OwnershipEvent::Kind::gained, cause, objects, 0, 0});
}

void ObjectRows::lose(std::size_t object, OwnerChange cause, std::uint32_t to) {
  Row& row = rows_[object];
  if (row.hold == Hold::none) return;
  row.hold = Hold::none;
  row.askers = {};
  row.asked = 0;
  ObjectSet one;
  one.set(object);
  core_.report({OwnershipEvent::Kind::lost, cause, one, row.transaction, to});
}

void ObjectRows::drop_all(OwnerChange cause) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) lose(i, cause, 0);
}

// The table names another owner.
void ObjectRows::note_table(std::size_t object, std::uint32_t from) {
  if (core_.table[object].owner == core_.config.epoch) return;
  if (holds(object)) {
    if (rows_[object].hold == Hold::granting) ++core_.counts.granted;
    lose(object, OwnerChange::granted, from);
  }
}

void ObjectRows::follow_act(nanoseconds lease_end) {
  const Act& act = core_.acts.decided();
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    Row& row = rows_[i];
    if (row.hold == Hold::none) continue;
    if (core_.table[i].owner != core_.config.epoch) {
      lose(i, OwnerChange::adopted, core_.table[i].owner);
    } else if (!act.roll.contains(core_.config.epoch)) {
      lose(i, OwnerChange::adopted, 0);
    }
    if (row.hold == Hold::none || act_of(core_.table[i].version) == act.number) continue;
    const nanoseconds until = lease_end + LeaseBook::kGrace;
    row.until = row.confirmed ? until : std::min(row.until, until);
    row.confirmed = false;
    row.agreed = 0;
    row.first_serial = serial + 1;
  }
}

// The new owner has not taken the object and cannot any more.
void ObjectRows::take_back(std::size_t object) {
  Row& row = rows_[object];
  Tenure tenure = core_.table[object];
  tenure.version += 2;
  core_.table.set(object, tenure);
  row.hold = Hold::owned;
  ObjectSet one;
  one.set(object);
  core_.report({OwnershipEvent::Kind::gained, OwnerChange::returned, one, row.transaction, row.to});
}

void ObjectRows::release(const ObjectSet& objects) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!objects[i] || rows_[i].hold == Hold::none) continue;
    Tenure tenure = core_.table[i];
    tenure.owner = 0;
    core_.table.set(i, tenure);
    ++core_.counts.released;
    lose(i, OwnerChange::adopted, 0);
  }
}

// What others believe us to own, and we do not hold, is free for the next act.
void ObjectRows::release_unheld() {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    const Tenure& tenure = core_.table[i];
    if (tenure.owner == core_.config.epoch && !holds(i)) core_.table.set(i, {tenure.version, 0});
  }
}

}  // namespace reckon::peer

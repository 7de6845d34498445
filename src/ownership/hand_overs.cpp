// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/hand_overs.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// An asker is remembered for this time after its last request.
constexpr nanoseconds kRemembered = std::chrono::seconds(3);
constexpr nanoseconds kLeastLease = milliseconds(200);  // remainder that an owner needs to grant
constexpr nanoseconds kFreshRound = milliseconds(1000);
// Time that an unconfirmed owner loses, for clocks of different rates.
constexpr nanoseconds kMargin = milliseconds(100);

// A request is repeated, so that the owner remembers it.
constexpr nanoseconds kAskAgain = std::chrono::seconds(1);

}  // namespace

// The state of an object

bool HandOvers::owns(std::size_t object, nanoseconds now) const noexcept {
  const Row& row = rows_[object];
  return row.hold == Hold::owned && (row.confirmed || now < row.until);
}

ObjectSet HandOvers::held() const noexcept {
  ObjectSet held;
  for (std::size_t i = 0; i < core_.table.size(); ++i) held[i] = holds(i);
  return held;
}

bool HandOvers::has_granted(nanoseconds now) const noexcept { return now - granted_at_ <= kGiveUp; }

bool HandOvers::is_granting() const noexcept {
  return std::ranges::any_of(rows_, [](const Row& row) { return row.hold == Hold::granting; });
}

bool HandOvers::is_busy() const noexcept {
  return std::ranges::any_of(std::span(rows_).first(core_.table.size()), [](const Row& row) {
    const bool unsettled = row.hold != Hold::none && (row.hold != Hold::owned || !row.confirmed);
    return unsettled || (row.wanted && row.hold == Hold::none) || row.askers[0].epoch != 0;
  });
}

void HandOvers::gain(const ObjectSet& objects, OwnerChange cause) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!objects[i]) continue;
    Row& row = rows_[i];
    row.hold = Hold::owned;
    row.confirmed = true;
    row.askers = {};
  }
  core_.report({OwnershipEvent::Kind::gained, cause, objects, 0, 0});
}

void HandOvers::lose(std::size_t object, OwnerChange cause, std::uint32_t to) {
  Row& row = rows_[object];
  if (row.hold == Hold::none) return;
  row.hold = Hold::none;
  row.askers = {};
  row.asked = 0;
  ObjectSet one;
  one.set(object);
  core_.report({OwnershipEvent::Kind::lost, cause, one, row.transaction, to});
}

void HandOvers::drop_all(OwnerChange cause) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) lose(i, cause, 0);
  outgoing_.fill({});
  incoming_.fill({});
}

// The table names another owner.
void HandOvers::note_table(std::size_t object, std::uint32_t from) {
  if (core_.table[object].owner == core_.config.epoch) return;
  if (holds(object)) {
    if (rows_[object].hold == Hold::granting) ++core_.counts.granted;
    lose(object, OwnerChange::granted, from);
  }
}

void HandOvers::follow_act(nanoseconds lease_end) {
  const Act& act = core_.acts.decided();
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    Row& row = rows_[i];
    if (row.hold == Hold::none) continue;
    if (core_.table[i].owner != core_.config.epoch) {
      lose(i, OwnerChange::adopted, core_.table[i].owner);
    } else if (!act.roll.contains(core_.config.epoch)) {
      lose(i, OwnerChange::adopted, 0);
    } else if (row.hold == Hold::granting && !act.roll.contains(row.to)) {
      take_back(i);
    }
    if (row.hold == Hold::none || act_of(core_.table[i].version) == act.number) continue;
    const nanoseconds until = lease_end + LeaseBook::kDead - LeaseBook::kLease - kMargin;
    row.until = row.confirmed ? until : std::min(row.until, until);
    row.confirmed = false;
    row.agreed = 0;
    row.first_serial = serial_ + 1;
  }
}

// The new owner has not taken the object and cannot any more.
void HandOvers::take_back(std::size_t object) {
  Row& row = rows_[object];
  Tenure tenure = core_.table[object];
  tenure.version += 2;
  core_.table.set(object, tenure);
  row.hold = Hold::owned;
  ObjectSet one;
  one.set(object);
  core_.report({OwnershipEvent::Kind::gained, OwnerChange::returned, one, row.transaction, row.to});
}

void HandOvers::release(const ObjectSet& objects) {
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
void HandOvers::release_unheld() {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    const Tenure& tenure = core_.table[i];
    if (tenure.owner == core_.config.epoch && !holds(i)) core_.table.set(i, {tenure.version, 0});
  }
}

// Asking

void HandOvers::withdraw(std::size_t object) {
  Row& row = rows_[object];
  row.wanted = false;
  if (row.asked == 0) return;
  Request request;
  request.objects.set(object);
  request.withdraws = true;
  core_.send(row.asked, request, true);
  row.asked = 0;
}

// One request to each owner names all objects that are due.
void HandOvers::ask_due(nanoseconds now) {
  if (!core_.acts.decided().roll.contains(core_.config.epoch) || core_.is_leaving) return;
  ObjectSet due;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    Row& row = rows_[i];
    const std::uint32_t owner = core_.table[i].owner;
    if (!row.wanted || row.hold != Hold::none || owner == 0 || owner == core_.config.epoch)
      continue;
    if (row.asked != owner) row.asked = owner, row.ask_at = now;
    due[i] = now >= row.ask_at;
  }
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!due[i]) continue;
    Request request;
    for (std::size_t j = i; j < core_.table.size(); ++j) {
      if (!due[j] || rows_[j].asked != rows_[i].asked) continue;
      request.objects.set(j);
      due.reset(j);
      rows_[j].ask_at = now + kAskAgain;
    }
    core_.send(rows_[i].asked, request, true);
  }
}

void HandOvers::receive(const Request& request, std::uint32_t from, nanoseconds now) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!request.objects[i]) continue;
    auto& askers = rows_[i].askers;
    const auto known = std::ranges::find(askers, from, &Asker::epoch);
    if (request.withdraws) {
      if (known == askers.end()) continue;
      std::copy(known + 1, askers.end(), known);
      askers.back() = {};
      continue;
    }
    if (rows_[i].hold != Hold::owned || !core_.user.may_take(i, from)) continue;
    if (known != askers.end()) {
      known->heard = now;
      continue;
    }
    const auto room = std::ranges::find(askers, 0U, &Asker::epoch);
    if (room != askers.end()) *room = {from, now};
  }
}

// Granting

bool HandOvers::can_grant(std::size_t object, nanoseconds now) const {
  return rows_[object].hold == Hold::owned && rows_[object].confirmed && !is_closed_ &&
         !core_.user.is_busy(object) && core_.lease_end(now) - now >= kLeastLease &&
         core_.acts.pending() == nullptr;
}

void HandOvers::grant_due(nanoseconds now) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    auto& askers = rows_[i].askers;
    while (askers[0].epoch != 0 && now - askers[0].heard > kRemembered) {
      std::copy(askers.begin() + 1, askers.end(), askers.begin());
      askers.back() = {};
    }
    const std::uint32_t to = askers[0].epoch;
    if (to == 0 || !core_.acts.decided().roll.contains(to) || core_.is_leaving) continue;
    if (now - core_.leases.heard_at(to) <= kFreshRound && can_grant(i, now)) begin_grant(i, to);
  }
}

// All objects of the company are ours and may go, or none goes.
void HandOvers::begin_grant(std::size_t object, std::uint32_t to) {
  const auto free = std::ranges::find(outgoing_, 0U, &Outgoing::transaction);
  if (free == outgoing_.end()) return;
  ObjectSet company = core_.user.company_of(object);
  company.set(object);
  if (company.count() > kMostHoldings) return;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!company[i]) continue;
    const Row& row = rows_[i];
    const bool goes = row.hold == Hold::owned && row.confirmed && core_.user.may_take(i, to) &&
                      !core_.user.is_busy(i);
    if (!goes) return;
  }
  *free = {};
  free->transaction = ++transactions_;
  free->to = to;
  free->objects = company;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!company[i]) continue;
    Row& row = rows_[i];
    row.hold = Hold::yielding;
    row.transaction = free->transaction;
    row.to = to;
    const auto asker = std::ranges::find(row.askers, to, &Asker::epoch);
    if (asker == row.askers.end()) continue;
    std::copy(asker + 1, row.askers.end(), asker);
    row.askers.back() = {};
  }
  core_.report({OwnershipEvent::Kind::yield, OwnerChange::granted, company, free->transaction, to});
}

void HandOvers::yielded(std::uint32_t transaction, nanoseconds now) {
  const auto grant = std::ranges::find(outgoing_, transaction, &Outgoing::transaction);
  if (grant == outgoing_.end()) return;
  const nanoseconds lease = core_.lease_end(now) - now;
  const bool may_go = lease >= kLeastLease && !is_closed_ && core_.acts.pending() == nullptr &&
                      core_.acts.decided().roll.contains(grant->to);
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    Row& row = rows_[i];
    if (row.hold != Hold::yielding || row.transaction != transaction) continue;
    row.hold = Hold::granting;
    row.since = core_.leases.heard_at(grant->to);
    if (may_go) {
      core_.table.name(i, {core_.table[i].version + 1, grant->to});
    } else {
      take_back(i);
    }
  }
  if (may_go) {
    granted_at_ = now;
    grant->lease_ms =
        static_cast<std::uint32_t>(std::chrono::duration_cast<milliseconds>(lease).count());
    send_grant(*grant, now);
  }
  *grant = {};
}

void HandOvers::send_grant(const Outgoing& grant, nanoseconds now) {
  Grant part;
  part.transaction = grant.transaction;
  part.to = grant.to;
  part.round = core_.leases.round_of(grant.to, now);
  part.lease_ms = grant.lease_ms;
  part.objects = grant.objects;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!grant.objects[i]) continue;
    part.part[part.count] = {static_cast<std::uint16_t>(i), {core_.table[i].version + 1, grant.to}};
    part.states[part.count++] = rows_[i].state;
    if (part.count < part.part.size()) continue;
    core_.send(0, part, true);
    part.count = 0;
  }
  if (part.count > 0) core_.send(0, part, true);
}

void HandOvers::receive(const Refusal& refusal, std::uint32_t from) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    const Row& row = rows_[i];
    if (row.hold == Hold::granting && row.transaction == refusal.transaction && row.to == from)
      take_back(i);
  }
}

void HandOvers::give_up(nanoseconds now) {
  ObjectSet late;
  for (std::size_t i = 0; i < core_.table.size(); ++i)
    late[i] = rows_[i].hold == Hold::granting && now - rows_[i].since > kGiveUp;
  if (late.any()) release(late);
}

}  // namespace reckon::peer

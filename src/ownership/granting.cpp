// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/granting.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using Hold = ObjectRow::Hold;
using Row = ObjectRow;

// An asker is remembered for this time after its last request.
constexpr nanoseconds kRemembered = std::chrono::seconds(3);
constexpr nanoseconds kLeastLease = milliseconds(200);  // remainder that an owner needs to grant
constexpr nanoseconds kFreshRound = milliseconds(1000);

}  // namespace

bool Granting::has_granted(nanoseconds now) const noexcept { return now - granted_at_ <= kGiveUp; }

void Granting::receive(const Request& request, std::uint32_t from, nanoseconds now) {
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

bool Granting::can_grant(std::size_t object, nanoseconds now) const {
  return rows_[object].hold == Hold::owned && rows_[object].confirmed && !is_closed_ &&
         !core_.user.is_busy(object) && core_.lease_end(now) - now >= kLeastLease &&
         core_.acts.pending() == nullptr;
}

void Granting::grant_due(nanoseconds now) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    auto& askers = rows_[i].askers;
    while (askers[0].epoch != 0 && now - askers[0].heard > kRemembered) {
      std::copy(askers.begin() + 1, askers.end(), askers.begin());
      askers.back() = {};
    }
    const std::uint32_t to = askers[0].epoch;
    if (to == 0 || !core_.acts.decided().roll.contains(to)) continue;
    if (now - core_.leases.heard_at(to) <= kFreshRound && can_grant(i, now)) grant_company(i, to);
  }
}

// All objects of the company are ours and may go, or none goes.
void Granting::grant_company(std::size_t object, std::uint32_t to) {
  ObjectSet company = core_.user.company_of(object);
  company.set(object);
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!company[i]) continue;
    const Row& row = rows_[i];
    const bool goes = row.hold == Hold::owned && row.confirmed && core_.user.may_take(i, to) &&
                      !core_.user.is_busy(i);
    if (!goes) return;
  }
  begin_grant(company, to);
}

void Granting::begin_grant(const ObjectSet& objects, std::uint32_t to) {
  const auto free = std::ranges::find(outgoing_, 0U, &Outgoing::transaction);
  if (free == outgoing_.end() || objects.count() > kMostHoldings) return;
  *free = {};
  free->transaction = ++transactions_;
  free->to = to;
  free->objects = objects;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!objects[i]) continue;
    Row& row = rows_[i];
    row.hold = Hold::yielding;
    row.transaction = free->transaction;
    row.to = to;
    const auto asker = std::ranges::find(row.askers, to, &Asker::epoch);
    if (asker == row.askers.end()) continue;
    std::copy(asker + 1, row.askers.end(), asker);
    row.askers.back() = {};
  }
  core_.report({OwnershipEvent::Kind::yield, OwnerChange::granted, objects, free->transaction, to});
}

// A leaver gives its objects to the most senior voter that it receives, also those that a hand
// holds.
void Granting::push_all(nanoseconds now) {
  leaving_at_ = std::min(leaving_at_, now);
  if (is_closed_ || core_.acts.pending() != nullptr || core_.lease_end(now) - now < kLeastLease)
    return;
  for (const Voter& voter : core_.acts.decided().roll.voters()) {
    const bool is_here = now - core_.leases.heard_at(voter.epoch) <= kFreshRound;
    if (voter.epoch == core_.config.epoch || !is_here) continue;
    ObjectSet batch;
    for (std::size_t i = 0; i < core_.table.size() && batch.count() < kMostHoldings; ++i) {
      batch[i] =
          rows_[i].hold == Hold::owned && rows_[i].confirmed && core_.user.may_take(i, voter.epoch);
    }
    if (batch.any()) begin_grant(batch, voter.epoch);
  }
}

bool Granting::gives_away(nanoseconds now) const noexcept {
  return now < leaving_at_ || (now - leaving_at_ < kPush && rows_.held().any());
}

void Granting::yielded(std::uint32_t transaction, nanoseconds now) {
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
      rows_.take_back(i);
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

void Granting::send_grant(const Outgoing& grant, nanoseconds now) {
  Grant part;
  part.transaction = grant.transaction;
  part.to = grant.to;
  part.round = core_.leases.round_of(grant.to, now);
  part.lease_ms = grant.lease_ms;
  part.objects = grant.objects;
  part.is_pushed = core_.is_leaving;
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

void Granting::receive(const GrantRefusal& refusal, std::uint32_t from) {
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    const Row& row = rows_[i];
    if (row.hold == Hold::granting && row.transaction == refusal.transaction && row.to == from)
      rows_.take_back(i);
  }
}

void Granting::give_up(nanoseconds now) {
  ObjectSet late;
  for (std::size_t i = 0; i < core_.table.size(); ++i)
    late[i] = rows_[i].hold == Hold::granting && now - rows_[i].since > kGiveUp;
  if (late.any()) rows_.release(late);
}

void Granting::step(nanoseconds now) {
  give_up(now);
  core_.is_leaving ? push_all(now) : grant_due(now);
}

}  // namespace reckon::peer

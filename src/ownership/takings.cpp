// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The side of a hand-over that takes objects.
#include <algorithm>

#include "reckon/peer/ownership/hand_overs.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kTakingMargin = milliseconds(100);
constexpr nanoseconds kAnnounceGap = milliseconds(20);

}  // namespace

// Whether this peer may own the objects of a grant now. The round shows that the grant is new.
bool HandOvers::may_take(const Grant& grant, std::uint32_t from, nanoseconds now) const {
  const ActBook& acts = core_.acts;
  const auto sent = core_.leases.sent_at(grant.round, now);
  if (!sent || now - *sent >= kTake || acts.pending() != nullptr || core_.is_leaving) return false;
  if (!acts.decided().roll.contains(core_.config.epoch) || !acts.decided().roll.contains(from))
    return false;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (grant.objects[i] && !core_.user.may_take(i, core_.config.epoch)) return false;
  }
  return std::ranges::all_of(grant.holdings(), [&](const Holding& holding) {
    if (holding.object >= core_.table.size() || !grant.objects[holding.object]) return false;
    return holding.tenure.owner == core_.config.epoch &&
           core_.table.may_grant(holding.object, from) &&
           is_newer(holding.tenure, core_.table[holding.object]) &&
           act_of(holding.tenure.version) <= acts.decided().number &&
           count_of(holding.tenure.version) < kMostHandOvers;
  });
}

// Whether the table is as new as the grant.
bool HandOvers::is_outdated(const Grant& grant) const noexcept {
  return std::ranges::any_of(grant.holdings(), [&](const Holding& holding) {
    return holding.object < core_.table.size() &&
           core_.table[holding.object].version >= holding.tenure.version;
  });
}

// Null if there is no room: only an entry whose grant cannot be taken any more makes room.
HandOvers::Incoming* HandOvers::incoming_of(const Grant& grant, std::uint32_t from,
                                            nanoseconds now) {
  const auto known = std::ranges::find_if(incoming_, [&](const Incoming& incoming) {
    return incoming.transaction == grant.transaction && incoming.from == from;
  });
  if (known != incoming_.end()) return &*known;
  Incoming& room = *std::ranges::min_element(incoming_, {}, &Incoming::heard);
  if (room.from != 0 && now - room.heard < kTake) return nullptr;
  room = {};
  room.transaction = grant.transaction;
  room.from = from;
  room.objects = grant.objects;
  room.heard = now;
  return &room;
}

// Every peer that receives a grant is a witness of the new owner. Only an object that we wanted is
// taken, or one in its company.
void HandOvers::receive(const Grant& grant, std::uint32_t from, nanoseconds now) {
  for (const Holding& holding : grant.holdings()) {
    if (holding.tenure.owner == grant.to && grant.to != from)
      core_.table.name(holding.object, holding.tenure);
  }
  if (grant.to != core_.config.epoch || is_outdated(grant)) return;
  Incoming* incoming = incoming_of(grant, from, now);
  if (incoming == nullptr || (incoming->arrived.any() && incoming->arrived == incoming->objects))
    return;
  bool is_wanted = false;
  for (std::size_t i = 0; i < core_.table.size(); ++i)
    is_wanted = is_wanted || (grant.objects[i] && rows_[i].wanted);
  incoming->is_refused = incoming->is_refused || !is_wanted || grant.objects != incoming->objects ||
                         !may_take(grant, from, now);
  incoming->heard = now;
  if (incoming->is_refused) {
    ++core_.counts.refused;
    Refusal refusal;
    refusal.transaction = grant.transaction;
    return core_.send(from, refusal, true);
  }
  for (std::size_t i = 0; i < grant.count; ++i) {
    const Holding& holding = grant.part[i];
    incoming->arrived.set(holding.object);
    incoming->tenures[holding.object] = holding.tenure.version;
    rows_[holding.object].state = grant.states[i];
  }
  if (incoming->arrived == incoming->objects) take(*incoming, grant, now);
}

void HandOvers::take(const Incoming& grant, const Grant& last, nanoseconds now) {
  const nanoseconds sent = core_.leases.sent_at(last.round, now).value_or(now - kTake);
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!grant.objects[i]) continue;
    core_.table.set(i, {grant.tenures[i], core_.config.epoch});
    Row& row = rows_[i];
    const bool wanted = row.wanted;
    const ObjectState state = row.state;
    row = {};
    row.state = state;
    row.hold = Hold::owned;
    row.wanted = wanted;
    row.first_serial = serial_ + 1;
    row.until =
        sent + milliseconds(last.lease_ms) + LeaseBook::kDead - LeaseBook::kLease - kTakingMargin;
    ++core_.counts.taken;
  }
  core_.report({OwnershipEvent::Kind::gained, OwnerChange::granted, grant.objects,
                grant.transaction, grant.from});
  announce_at_ = now;
}

// Confirming

// An owner that is not confirmed asks all voters to note it.
void HandOvers::announce(nanoseconds now) {
  if (now < announce_at_) return;
  TableExtract extract;
  extract.asks = true;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    Row& row = rows_[i];
    if (row.hold == Hold::none || row.confirmed) continue;
    confirm_if_agreed(row);
    if (!row.confirmed && !extract.holdings.add(i, core_.table[i])) break;
  }
  if (extract.holdings.count == 0) return;
  announce_at_ = now + kAnnounceGap;
  extract.serial = ++serial_;
  core_.send(0, extract);
}

void HandOvers::confirm_if_agreed(Row& row) noexcept {
  const Roll& roll = core_.acts.decided().roll;
  if (core_.acts.pending() != nullptr) return;
  row.confirmed = roll.is_majority([&](const Voter& voter) {
    return voter.epoch == core_.config.epoch || (row.agreed >> roll.index_of(voter.epoch) & 1) != 0;
  });
}

// An act that this peer has accepted bars the former owners.
bool HandOvers::may_agree(const Holding& holding, std::uint32_t from) const noexcept {
  const Roll& roll = core_.acts.decided().roll;
  if (holding.tenure.owner != from || !roll.contains(from) || !roll.contains(core_.config.epoch))
    return false;
  const Act* pending = core_.acts.pending();
  return pending == nullptr || (!pending->given[holding.object] && !pending->removes(from));
}

void HandOvers::receive(const TableExtract& extract, std::uint32_t from, nanoseconds now) {
  Agreement agreement;
  agreement.serial = extract.serial;
  TableExtract newer;
  for (const Holding& holding : extract.holdings.list()) {
    if (holding.object >= core_.table.size()) continue;
    const std::uint32_t owner = core_.table[holding.object].owner;
    const bool is_silent =
        owner != core_.config.epoch && now - core_.leases.silent_since(owner) >= LeaseBook::kDead;
    const Offer offer =
        core_.table.offer(holding.object, holding.tenure, from, core_.acts, is_silent);
    if (offer == Offer::taken) note_table(holding.object, from);
    if (offer == Offer::taken || offer == Offer::known) {
      if (may_agree(holding, from)) agreement.objects.set(holding.object);
    } else if (offer == Offer::older) {
      newer.holdings.add(holding.object, core_.table[holding.object]);
    } else {
      ++core_.counts.refused;
    }
  }
  if (!extract.asks) return;
  if (agreement.objects.any()) core_.send(from, agreement);
  if (newer.holdings.count > 0) core_.send(from, newer);
}

void HandOvers::receive(const Agreement& agreement, std::uint32_t from) {
  const std::size_t voter = core_.acts.decided().roll.index_of(from);
  if (voter == Roll::kNone || serial_ - agreement.serial > 50) return;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    Row& row = rows_[i];
    const bool is_for_us = agreement.objects[i] && row.hold != Hold::none && !row.confirmed &&
                           agreement.serial >= row.first_serial;
    if (!is_for_us) continue;
    row.agreed |= std::uint64_t{1} << voter;
    confirm_if_agreed(row);
  }
}

void HandOvers::step(nanoseconds now) {
  give_up(now);
  release_unheld();
  grant_due(now);
  ask_due(now);
  announce(now);
}

}  // namespace reckon::peer

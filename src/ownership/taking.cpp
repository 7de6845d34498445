// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/taking.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using Hold = ObjectRow::Hold;
using Row = ObjectRow;

// A request is repeated, so that the owner remembers it.
constexpr nanoseconds kAskAgain = std::chrono::seconds(1);
constexpr nanoseconds kAnnounceGap = milliseconds(20);

}  // namespace

void Taking::withdraw(std::size_t object) {
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
void Taking::ask_due(nanoseconds now) {
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

// Whether this peer may own the objects of a grant now. The round shows that the grant is new.
bool Taking::may_take(const Grant& grant, std::uint32_t from, nanoseconds now) const {
  const ActBook& acts = core_.acts;
  const auto sent = core_.leases.sent_at(grant.round, now);
  if (!core_.is_informed()) return false;
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
bool Taking::is_outdated(const Grant& grant) const noexcept {
  return std::ranges::any_of(grant.holdings(), [&](const Holding& holding) {
    return holding.object < core_.table.size() &&
           core_.table[holding.object].version >= holding.tenure.version;
  });
}

// Null if there is no room: only an entry whose grant cannot be taken any more makes room.
Taking::Incoming* Taking::incoming_of(const Grant& grant, std::uint32_t from, nanoseconds now) {
  const auto known = std::ranges::find_if(incoming_, [&](const Incoming& incoming) {
    return incoming.transaction == grant.transaction && incoming.from == from;
  });
  if (known != incoming_.end()) return &*known;
  // The table refuses the repetition of a grant that was taken.
  const auto free = std::ranges::find_if(incoming_, [now](const Incoming& incoming) {
    const bool is_taken = incoming.arrived.any() && incoming.arrived == incoming.objects;
    return incoming.from == 0 || is_taken || now - incoming.heard >= kTake;
  });
  if (free == incoming_.end()) return nullptr;
  Incoming& room = *free;
  room = {};
  room.transaction = grant.transaction;
  room.from = from;
  room.objects = grant.objects;
  room.heard = now;
  return &room;
}

// Every peer that receives a grant is a witness of the new owner. Only an object that we wanted is
// taken, or one in its company, or one of a leaver.
void Taking::receive(const Grant& grant, std::uint32_t from, nanoseconds now) {
  for (const Holding& holding : grant.holdings()) {
    if (holding.tenure.owner == grant.to && grant.to != from)
      core_.table.name(holding.object, holding.tenure);
  }
  if (grant.to != core_.config.epoch || is_outdated(grant)) return;
  Incoming* incoming = incoming_of(grant, from, now);
  if (incoming == nullptr || (incoming->arrived.any() && incoming->arrived == incoming->objects))
    return;
  bool is_wanted = grant.is_pushed;
  for (std::size_t i = 0; i < core_.table.size(); ++i)
    is_wanted = is_wanted || (grant.objects[i] && rows_[i].wanted);
  incoming->is_refused = incoming->is_refused || !is_wanted || grant.objects != incoming->objects ||
                         !may_take(grant, from, now);
  incoming->heard = now;
  if (incoming->is_refused) {
    ++core_.counts.refused;
    GrantRefusal refusal;
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

void Taking::take(const Incoming& grant, const Grant& last, nanoseconds now) {
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
    row.first_serial = rows_.serial + 1;
    row.until = sent + milliseconds(last.lease_ms) + LeaseBook::kGrace;
    ++core_.counts.taken;
  }
  core_.report({OwnershipEvent::Kind::gained, OwnerChange::granted, grant.objects,
                grant.transaction, grant.from});
  announce_at_ = now;
}

// Confirming

// An owner that is not confirmed asks all voters to note it.
void Taking::announce(nanoseconds now) {
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
  extract.serial = ++rows_.serial;
  core_.send(0, extract);
}

void Taking::confirm_if_agreed(Row& row) noexcept {
  const Roll& roll = core_.acts.decided().roll;
  if (core_.acts.pending() != nullptr) return;
  row.confirmed = roll.is_majority([&](const Voter& voter) {
    return voter.epoch == core_.config.epoch || (row.agreed >> roll.index_of(voter.epoch) & 1) != 0;
  });
}

// An act that this peer has accepted bars the former owners.
bool Taking::may_agree(const Holding& holding, std::uint32_t from) const noexcept {
  const Roll& roll = core_.acts.decided().roll;
  const bool are_voters = roll.contains(from) && roll.contains(core_.config.epoch);
  if (holding.tenure.owner != from || !are_voters || !core_.is_informed()) return false;
  const Act* pending = core_.acts.pending();
  return pending == nullptr || (!pending->given[holding.object] && !pending->removes(from));
}

void Taking::receive(const TableExtract& extract, std::uint32_t from, nanoseconds now) {
  Agreement agreement;
  agreement.serial = extract.serial;
  TableExtract newer;
  const bool is_whole = extract.act >= core_.acts.decided().number &&
                        core_.acts.decided().roll.contains(from) && core_.acts.exists();
  for (const Holding& holding : extract.holdings.list()) {
    if (holding.object >= core_.table.size()) continue;
    // After an act that this peer missed, there may be no witness but its chair.
    const bool is_missed =
        is_whole && core_.unknown[holding.object] &&
        act_of(holding.tenure.version) > act_of(core_.table[holding.object].version);
    if (is_whole) core_.unknown.reset(holding.object);
    const std::uint32_t owner = core_.table[holding.object].owner;
    const bool is_silent =
        owner != core_.config.epoch && now - core_.leases.silent_since(owner) >= LeaseBook::kDead;
    const Offer offer =
        core_.table.offer(holding.object, holding.tenure, from, core_.acts, is_silent || is_missed);
    if (offer == Offer::taken) rows_.note_table(holding.object, from);
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

void Taking::receive(const Agreement& agreement, std::uint32_t from) {
  const std::size_t voter = core_.acts.decided().roll.index_of(from);
  if (voter == Roll::kNone || rows_.serial - agreement.serial > 50) return;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    Row& row = rows_[i];
    const bool is_for_us = agreement.objects[i] && row.hold != Hold::none && !row.confirmed &&
                           agreement.serial >= row.first_serial;
    if (!is_for_us) continue;
    row.agreed |= std::uint64_t{1} << voter;
    confirm_if_agreed(row);
  }
}

void Taking::step(nanoseconds now) {
  rows_.release_unheld();
  ask_due(now);
  announce(now);
}

}  // namespace reckon::peer

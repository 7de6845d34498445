// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/ownership.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kSlowRound = milliseconds(500);
constexpr nanoseconds kFound = milliseconds(1200);       // without an older peer
constexpr nanoseconds kActive = milliseconds(1000);      // after the last active round
constexpr nanoseconds kQuietVoter = milliseconds(1200);  // then rounds are fast
constexpr nanoseconds kShortLease = milliseconds(1300);  // then rounds are fast
constexpr nanoseconds kDecidedGap = milliseconds(30);
constexpr nanoseconds kTableGap = milliseconds(150), kDiffers = milliseconds(100);
constexpr nanoseconds kThreat = milliseconds(1000);
constexpr std::uint32_t kMostAttempts = 1000;    // ahead of those known here
constexpr std::uint32_t kMostMissed = 1U << 16;  // acts

}  // namespace

void Ownership::receive(std::uint32_t from, const OwnershipMessage& message, nanoseconds now) {
  if (from == 0 || from == core_.config.epoch) return;
  const WorldId world = std::visit([](const auto& sent) { return sent.world; }, message);
  const Round* round = std::get_if<Round>(&message);
  // An Acknowledge PDU names no world.
  const bool is_refusal = std::holds_alternative<Refusal>(message);
  if (!is_refusal && !is_of_world(world, round, from, now)) return;
  std::visit(
      [&](const auto& sent) {
        using Message = std::decay_t<decltype(sent)>;
        if constexpr (std::is_same_v<Message, Round> || std::is_same_v<Message, Proposal> ||
                      std::is_same_v<Message, Vote>) {
          receive(sent, from, now);
        } else if constexpr (std::is_same_v<Message, Refusal> ||
                             std::is_same_v<Message, Agreement>) {
          hand_overs_.receive(sent, from);
        } else {
          hand_overs_.receive(sent, from, now);
        }
      },
      message);
}

// Worlds

bool Ownership::is_of_world(const WorldId& world, const Round* round, std::uint32_t from,
                            nanoseconds now) {
  if (round != nullptr && round->act == 0) {
    chair_.note_newcomer(from, world, now);
    core_.leases.receive(from, round->round, now);
    if (core_.acts.exists()) send_decided(from, now);
    return false;
  }
  if (!world.exists()) return false;
  if (core_.world == world) return true;
  if (core_.acts.exists()) {
    // An older world has precedence, and any that has a majority if ours has none for long.
    const bool is_older = world < core_.world || now - leased_ > LeaseBook::kDead;
    if (round == nullptr || !round->has_lease || !is_older) return false;
    merge(world);
  }
  core_.world = world;
  joined_ = now;
  return true;
}

void Ownership::merge(const WorldId& older) {
  hand_overs_.drop_all(OwnerChange::merged);
  core_.acts.clear();
  core_.table.clear();
  chair_.end();
  core_.world = older;
  ++core_.counts.merged;
  core_.report({OwnershipEvent::Kind::merged, OwnerChange::merged, {}, 0, older.founder});
}

void Ownership::found_if_due(nanoseconds now) {
  // The peers of a world that we wanted to join have gone.
  if (!core_.acts.exists() && core_.world.exists() && now - joined_ > LeaseBook::kDead)
    core_.world = {};
  if (!core_.config.votes || core_.world.exists() || now - started_ < kFound) return;
  const WorldId own{core_.config.started + founded_, core_.config.epoch};
  if (chair_.is_preceded(own, now)) return;
  core_.world = own;
  ++founded_;
  Act act;
  act.number = 1;
  act.chair = core_.config.epoch;
  act.roll.add({core_.config.epoch, 0});
  for (std::size_t i = 0; i < core_.table.size(); ++i) act.given.set(i);
  decide(act, now);
}

void Ownership::go_alone(std::uint32_t utc, nanoseconds now) {
  const std::uint32_t number = core_.acts.newest().number + 1;
  core_.acts.clear();
  core_.world = {utc, core_.config.epoch};
  chair_.forget_newcomers();
  Act act;
  act.number = number;
  act.chair = core_.config.epoch;
  act.roll.add({core_.config.epoch, 0});
  for (std::size_t i = 0; i < core_.table.size(); ++i) act.given.set(i);
  decide(act, now);
}

// Rounds

void Ownership::receive(const Round& round, std::uint32_t from, nanoseconds now) {
  core_.leases.receive(from, round.round, now);
  if (round.is_active) active_at_ = now;
  if (round.yields_to != 0) chair_.note_leaving(from, round.yields_to, now);
  const std::size_t place = core_.acts.decided().roll.index_of(from);
  if (place != Roll::kNone) tables_[place] = round.table;
  note_round(round, from, now);
  compare_tables(round, from, now);
}

void Ownership::note_round(const Round& round, std::uint32_t from, nanoseconds now) {
  const ActBook& acts = core_.acts;
  if (round.act < acts.decided().number ||
      (round.act == acts.decided().number && !round.is_decided))
    return send_decided(from, now);
  const bool is_same = round.act == acts.newest().number && round.hash == acts.hash();
  const std::size_t place = acts.newest().roll.index_of(core_.config.epoch);
  if (is_same && place != Roll::kNone) core_.leases.confirm(from, round.heard[place], now);
  if (!acts.decided().roll.contains(from) && round.act == acts.decided().number)
    chair_.note_newcomer(from, {~0U, from}, now);
}

// Tables that differ for some time are sent; soon only by the more senior of two peers.
void Ownership::compare_tables(const Round& round, std::uint32_t from, nanoseconds now) {
  if (!core_.acts.exists() || round.table == core_.table.hash()) return;
  if (now - differed_ > 2 * kSlowRound) differs_since_ = now;
  differed_ = now;
  const Roll& roll = core_.acts.decided().roll;
  const bool is_senior = roll.index_of(core_.config.epoch) < roll.index_of(from);
  const bool is_due =
      now - differs_since_ >= (is_senior ? kDiffers : 3 * kDiffers) || round.table == 0;
  if (is_due && now - table_sent_ >= kTableGap) send_table(now);
}

void Ownership::send_table(nanoseconds now) {
  table_sent_ = now;
  TableExtract extract;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (core_.table[i] == Tenure{}) continue;
    extract.holdings.add(i, core_.table[i]);
    if (extract.holdings.count < kMostHoldings) continue;
    core_.send(0, extract);
    extract.holdings = {};
  }
  if (extract.holdings.count > 0) core_.send(0, extract);
}

void Ownership::send_decided(std::uint32_t to, nanoseconds now) {
  if (now - decided_sent_ < kDecidedGap) return;
  decided_sent_ = now;
  Proposal decided;
  decided.act = core_.acts.decided();
  decided.is_decided = true;
  core_.send(to, decided);
}

// This peer agrees to be removed once a majority knows to whom it has given objects.
std::uint32_t Ownership::yields_to(nanoseconds now) noexcept {
  if (!core_.is_leaving && !complies_) {
    hand_overs_.open();
    return 0;
  }
  hand_overs_.close();
  const std::uint32_t table = core_.table.hash();
  const Roll& roll = core_.acts.decided().roll;
  const bool is_known = roll.is_majority([&](const Voter& voter) {
    return voter.epoch == core_.config.epoch || tables_[roll.index_of(voter.epoch)] == table;
  });
  if (hand_overs_.has_granted(now) && (!is_known || hand_overs_.is_granting())) return 0;
  return core_.is_leaving ? kAnyAct : threat_.act;
}

bool Ownership::is_active(nanoseconds now) const {
  if (core_.user.is_any_awake() || hand_overs_.is_busy()) return true;
  if (core_.acts.pending() != nullptr || core_.is_leaving) return true;
  if (hand_overs_.held().any() && core_.lease_end(now) - now < kShortLease) return true;
  return std::ranges::any_of(core_.acts.decided().roll.voters(), [&](const Voter& voter) {
    return voter.epoch != core_.config.epoch &&
           now - core_.leases.silent_since(voter.epoch) > kQuietVoter;
  });
}

void Ownership::send_round(nanoseconds now) {
  if (!core_.config.votes) return;
  const bool is_active_here = is_active(now);
  const bool is_fast = is_active_here || now - active_at_ < kActive || !is_voter();
  if (now - round_at_ < (is_fast ? LeaseBook::kRound : kSlowRound)) return;
  round_at_ = now;
  const Act& act = core_.acts.newest();
  Round round;
  round.act = core_.acts.exists() ? act.number : 0;
  round.hash = core_.acts.hash();
  round.table = core_.table.hash();
  round.round = core_.leases.round(now);
  round.is_decided = core_.acts.pending() == nullptr;
  round.is_active = is_active_here;
  round.has_lease = core_.has_lease(now);
  round.yields_to = yields_to(now);
  agrees_ = round.yields_to != 0;
  const auto voters = act.roll.voters();
  for (std::size_t i = 0; i < voters.size(); ++i)
    round.heard[i] = core_.leases.round_of(voters[i].epoch, now);
  core_.send(0, round);
  if (core_.acts.exists()) return;
  std::get<Round>(core_.out.back().message).world = {core_.config.started + founded_,
                                                     core_.config.epoch};
}

// Acts

bool Ownership::accepts_removals(const Act& act, nanoseconds now) const {
  const Act& last = core_.acts.decided();
  for (const Voter& voter : last.roll.voters()) {
    const bool is_removed = !act.roll.contains(voter.epoch);
    if (is_removed != act.removes(voter.epoch)) return false;
    if (!is_removed) continue;
    const bool is_own = voter.epoch == core_.config.epoch;
    const bool agrees = is_own ? agrees_ : chair_.leaves(voter.epoch, act.number, now);
    const bool is_dead =
        !is_own && now - core_.leases.silent_since(voter.epoch) >= LeaseBook::kDead;
    if (!agrees && !is_dead) return false;
  }
  return act.chair == last.chair || act.removes(last.chair);
}

// An object is given only if its owner is removed or silent, or has released it, and if this peer
// knows of no newer owner than the proposer.
bool Ownership::accepts_gifts(const Proposal& proposal, nanoseconds now) {
  const Act& act = proposal.act;
  if (act.given.none()) return true;
  if (now - core_.leases.restarted() < LeaseBook::kDead) return false;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!act.given[i]) continue;
    const std::uint32_t owner = core_.table[i].owner;
    const bool is_silent =
        owner != core_.config.epoch && now - core_.leases.silent_since(owner) >= LeaseBook::kDead;
    if (act.roll.contains(owner) && !is_silent) return false;
  }
  if (core_.table.digest(act.given) == proposal.digest) return true;
  if (now - table_sent_ >= kTableGap / 3) send_table(now);
  return false;
}

bool Ownership::accepts(const Proposal& proposal, nanoseconds now) {
  const Act& act = proposal.act;
  if (!core_.acts.may_accept(act, proposal.ballot, proposal.seen)) return false;
  const bool is_known = core_.acts.pending() != nullptr && core_.acts.hash() == act.hash() &&
                        core_.acts.pending()->number == act.number;
  if (!act.roll.contains(act.chair)) return false;
  return is_known || (accepts_removals(act, now) && accepts_gifts(proposal, now));
}

void Ownership::receive(const Proposal& proposal, std::uint32_t from, nanoseconds now) {
  const Act& last = core_.acts.decided();
  if (proposal.is_decided) {
    const bool is_near = !core_.acts.exists() || proposal.act.number - last.number < kMostMissed;
    if (proposal.act.number > last.number && is_near) decide(proposal.act, now);
    return;
  }
  if (proposal.act.number <= last.number) return send_decided(from, now);
  if (proposal.act.number > last.number + 1 || !core_.acts.exists()) return;
  const bool is_sane = proposal.ballot.attempt <= core_.acts.promised().attempt + kMostAttempts &&
                       proposal.ballot.proposer == from;
  const bool may_vote =
      last.roll.contains(core_.config.epoch) || proposal.act.roll.contains(core_.config.epoch);
  if (!is_sane || !may_vote || !(last.roll.contains(from) || proposal.act.roll.contains(from)))
    return;
  if (accepts(proposal, now)) {
    if (core_.acts.pending() == nullptr) old_lease_ = core_.lease_end(now);
    core_.acts.accept(proposal.act, proposal.ballot, now);
    Vote vote;
    vote.act = proposal.act.number;
    vote.ballot = proposal.ballot;
    return core_.send(from, vote);
  }
  note_threat(proposal.act, now);
  if (const Act* pending = core_.acts.pending()) {
    Proposal other;
    other.act = *pending;
    other.ballot = core_.acts.accepted();
    other.seen = other.ballot;
    if (other.ballot > proposal.seen && other.ballot != proposal.ballot) core_.send(from, other);
  }
  if (proposal.ballot.proposer != core_.config.epoch) chair_.learn(proposal, now);
}

void Ownership::receive(const Vote& vote, std::uint32_t from, nanoseconds now) {
  if (chair_.count(vote, from)) decide(chair_.proposal().act, now);
}

void Ownership::decide(const Act& act, nanoseconds now) {
  const nanoseconds lease_end = core_.acts.pending() != nullptr ? old_lease_ : core_.lease_end(now);
  const bool is_first = !core_.acts.exists();
  if (!core_.acts.decide(act)) return;
  if (!is_first) core_.leases.restart(now);
  ObjectSet ours;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!act.given[i]) continue;
    core_.table.set(i, {version_of(act.number, 0), act.chair});
    ours[i] = act.chair == core_.config.epoch;
  }
  if (is_first) leased_ = now;
  hand_overs_.follow_act(lease_end);
  if (!is_voter()) core_.table.clear();
  chair_.end();
  tables_.fill(0);
  complies_ = false;
  threat_ = {};
  decided_sent_ = kNever;
  if (ours.any()) {
    core_.counts.adopted += is_first ? 0 : ours.count();
    hand_overs_.gain(ours, is_first ? OwnerChange::founded : OwnerChange::adopted);
  }
}

// A proposal that we refuse, and that others may have accepted, blocks all later acts. After a
// while we give it what it takes.
void Ownership::note_threat(const Act& act, nanoseconds now) noexcept {
  const ObjectSet taken = act.given & hand_overs_.held();
  const bool removes = act.removes(core_.config.epoch);
  if (!removes && taken.none()) return;
  if (threat_.act != act.number || now - threat_.seen > kThreat) {
    threat_ = {};
    threat_.act = act.number;
    threat_.since = now;
  }
  threat_.seen = now;
  threat_.removes = threat_.removes || removes;
  threat_.takes |= taken;
}

void Ownership::comply(nanoseconds now) {
  if (const Act* pending = core_.acts.pending()) note_threat(*pending, now);
  const bool is_open = threat_.act == core_.acts.decided().number + 1;
  complies_ = complies_ && is_open;
  // With a lease, a majority is on our side.
  if (!is_open || now - threat_.since < kThreat || now - leased_ < kThreat) return;
  complies_ = complies_ || threat_.removes;
  const ObjectSet taken = threat_.takes & hand_overs_.held();
  if (taken.any()) hand_overs_.release(taken);
}

void Ownership::propose(nanoseconds now) {
  const Proposal* proposal = chair_.step(now);
  if (proposal == nullptr) return;
  const Proposal sent = *proposal;
  if (!accepts(sent, now)) return;
  if (core_.acts.pending() == nullptr) old_lease_ = core_.lease_end(now);
  core_.acts.accept(sent.act, sent.ballot, now);
  core_.send(0, sent);
  Vote own;
  own.act = sent.act.number;
  own.ballot = sent.ballot;
  receive(own, core_.config.epoch, now);
  if (core_.acts.pending() == nullptr) send_decided(0, now);
}

// Steps

void Ownership::step(nanoseconds now) {
  if (started_ == kNever) started_ = now;
  if (stepped_ != kNever && now - stepped_ > kSlept) core_.leases.restart(now);
  stepped_ = now;
  found_if_due(now);
  if (core_.acts.exists()) {
    if (core_.has_lease(now)) leased_ = now;
    comply(now);
    propose(now);
    hand_overs_.step(now);
  }
  send_round(now);
}

bool Ownership::owns(std::size_t object, nanoseconds now) const noexcept {
  if (!hand_overs_.owns(object, now) || complies_ || core_.is_leaving || now - stepped_ > kSlept)
    return false;
  const Act* pending = core_.acts.pending();
  if (pending != nullptr && pending->removes(core_.config.epoch)) return false;
  return core_.has_lease(now);
}

bool Ownership::has_left() const noexcept {
  return core_.is_leaving && (!core_.acts.exists() || !is_voter());
}

}  // namespace reckon::peer

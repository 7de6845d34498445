// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/ownership.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kFound = milliseconds(1200);  // without an older peer
constexpr std::uint32_t kMostAttempts = 1000;       // ahead of those known here
constexpr std::uint32_t kMostMissed = 1U << 16;     // acts

}  // namespace

void Ownership::receive(std::uint32_t from, const OwnershipMessage& message, nanoseconds now) {
  if (from == 0 || from == core_.config.epoch) return;
  const WorldId world = std::visit([](const auto& sent) { return sent.world; }, message);
  const Round* round = std::get_if<Round>(&message);
  // An Acknowledge PDU names no world.
  const bool is_refusal = std::holds_alternative<GrantRefusal>(message);
  if (!is_refusal && !is_of_world(world, round, from, now)) return;
  std::visit(
      [&](const auto& sent) {
        using Message = std::decay_t<decltype(sent)>;
        if constexpr (std::is_same_v<Message, Round> || std::is_same_v<Message, Proposal> ||
                      std::is_same_v<Message, Vote>) {
          receive(sent, from, now);
        } else if constexpr (std::is_same_v<Message, GrantRefusal>) {
          granting_.receive(sent, from);
        } else if constexpr (std::is_same_v<Message, Request>) {
          granting_.receive(sent, from, now);
        } else if constexpr (std::is_same_v<Message, Agreement>) {
          taking_.receive(sent, from);
        } else {
          taking_.receive(sent, from, now);
        }
      },
      message);
}

// Worlds

bool Ownership::is_of_world(const WorldId& world, const Round* round, std::uint32_t from,
                            nanoseconds now) {
  if (round != nullptr && round->act == 0) {
    if (!round->follows) chair_.note_newcomer(from, world, now);
    core_.leases.receive(from, round->round, now);
    if (core_.acts.exists()) rounds_.send_decided(from, now);
    return false;
  }
  if (!world.exists()) return false;
  // A peer without a vote has no lease of its own: that of a voter counts.
  if (!is_voter() && round != nullptr && round->has_lease && core_.world == world) leased_ = now;
  if (core_.world == world) return true;
  if (round == nullptr) return false;
  // A world that could not admit us is joined again only if its voters have a majority.
  if (!round->has_lease && (core_.world.exists() || world == left_)) return false;
  if (core_.world.exists()) {
    // An older world has precedence, and any that has a majority if ours has none for long.
    const bool is_older = world < core_.world || now - leased_ > LeaseBook::kDead;
    if (!is_older) return false;
    if (core_.acts.exists()) merge(world);
  }
  core_.world = world;
  joined_ = now;
  recall_world();
  return true;
}

// A voter that returns to a world still has its vote there, so it must keep its promises.
void Ownership::remember_world() {
  if (!is_voter()) return;
  const auto known = std::ranges::find(former_, core_.world, &FormerWorld::world);
  FormerWorld& former = known != former_.end() ? *known : former_[formers_++ % former_.size()];
  former = {core_.world, core_.acts, core_.table};
}

void Ownership::recall_world() {
  const auto known = std::ranges::find(former_, core_.world, &FormerWorld::world);
  if (known == former_.end() || core_.acts.exists()) return;
  core_.acts = known->acts;
  core_.table = known->table;
  core_.forget_gifts();
}

void Ownership::merge(const WorldId& older) {
  leave_world();
  core_.world = older;
  ++core_.counts.merged;
  core_.report({OwnershipEvent::Kind::merged, OwnerChange::merged, {}, 0, older.founder});
}

void Ownership::leave_world() {
  remember_world();
  rows_.drop_all(OwnerChange::merged);
  granting_.clear();
  taking_.clear();
  core_.acts.clear();
  core_.table.clear();
  chair_.end();
  rounds_.follow_act(stepped_);
  voting_.follow_act();
  core_.world = {};
}

void Ownership::found_if_due(nanoseconds now) {
  // The peers of a world that we wanted to join have gone, or none of them can admit us.
  const bool waits = core_.acts.exists() && !is_voter();
  const nanoseconds since = waits ? std::max(joined_, leased_) : joined_;
  const bool is_outside = waits || !core_.acts.exists();
  if (core_.config.votes && is_outside && core_.world.exists() && now - since > LeaseBook::kDead) {
    left_ = core_.world;
    leave_world();
    core_.config.founds_at_once = false;
    started_ = now;
  }
  if (!core_.config.votes || core_.world.exists()) return;
  const bool is_early = now - started_ < kFound || chair_.is_preceded(core_.to_found, now);
  if (is_early && !core_.config.founds_at_once) return;
  core_.world = core_.to_found;
  ++core_.to_found.founded;
  found(1, now);
}

// The only voter, and the owner of all objects.
void Ownership::found(std::uint32_t number, nanoseconds now) {
  Act act;
  act.number = number;
  act.chair = core_.config.epoch;
  act.roll.add({core_.config.epoch, 0});
  for (std::size_t i = 0; i < core_.table.size(); ++i) act.given.set(i);
  is_founding_ = true;
  decide(act, now);
  is_founding_ = false;
}

void Ownership::go_alone(std::uint32_t utc, nanoseconds now) {
  const std::uint32_t number = core_.acts.newest().number + 1;
  remember_world();
  core_.acts.clear();
  core_.world = {utc, core_.config.epoch};
  chair_.forget_newcomers();
  found(number, now);
}

// Acts

void Ownership::receive(const Proposal& proposal, std::uint32_t from, nanoseconds now) {
  const Act& last = core_.acts.decided();
  if (proposal.phase == DecisionPhase::decided) {
    const bool is_near = !core_.acts.exists() || proposal.act.number - last.number < kMostMissed;
    if (proposal.act.number > last.number && is_near) decide(proposal.act, now);
    return;
  }
  if (proposal.act.number <= last.number) return rounds_.send_decided(from, now);
  const bool is_next = core_.acts.exists() && proposal.act.number == last.number + 1;
  const bool is_sane = proposal.ballot.attempt <= core_.acts.promised().attempt + kMostAttempts;
  const bool is_voter = last.roll.contains(from) || proposal.act.roll.contains(from);
  if (!is_next || !is_sane || !is_voter) return;
  if (proposal.phase == DecisionPhase::promise) return chair_.count_promise(proposal, from, now);
  if (proposal.ballot.proposer != from) return;
  chair_.note_other(proposal, now);
  if (proposal.phase == DecisionPhase::prepare) return promise(proposal, from);
  const std::uint32_t own = core_.config.epoch;
  if (!last.roll.contains(own) && !proposal.act.roll.contains(own)) return;
  if (!voting_.accepts(proposal, now)) {
    voting_.note_threat(proposal.act, now);
    if (proposal.ballot < core_.acts.promised()) promise(proposal, from);
    return;
  }
  accept(proposal, now);
  Vote vote;
  vote.act = proposal.act.number;
  vote.ballot = proposal.ballot;
  core_.send(from, vote);
}

// To a lower ballot than promised, the answer is that of the higher one.
void Ownership::promise(const Proposal& proposal, std::uint32_t from) {
  if (!is_voter()) return;
  if (proposal.ballot > core_.acts.promised()) core_.acts.promise(proposal.ballot);
  Proposal answer;
  answer.phase = DecisionPhase::promise;
  answer.ballot = core_.acts.promised();
  answer.act.number = proposal.act.number;
  if (const Act* pending = core_.acts.pending()) {
    answer.act = *pending;
    answer.accepted = core_.acts.accepted();
  }
  core_.send(from, answer);
}

void Ownership::accept(const Proposal& proposal, nanoseconds now) {
  if (core_.acts.pending() == nullptr) old_lease_ = core_.lease_end(now);
  core_.acts.accept(proposal.act, proposal.ballot);
}

void Ownership::receive(const Vote& vote, std::uint32_t from, nanoseconds now) {
  if (!chair_.count(vote, from)) return;
  decide(chair_.proposal().act, now);
  rounds_.send_decided(0, now);
}

void Ownership::decide(const Act& act, nanoseconds now) {
  const nanoseconds lease_end = core_.acts.pending() != nullptr ? old_lease_ : core_.lease_end(now);
  const bool is_first = !core_.acts.exists();
  const bool is_uninformed = !is_founding_ && !core_.is_informed();
  const bool is_missing_one = act.number != core_.acts.decided().number + 1;
  if (!core_.acts.decide(act)) return;
  const bool is_late = !is_founding_ && (is_first || is_missing_one);
  core_.unknown.reset();
  if (is_late || is_uninformed) core_.forget_gifts();
  if (!is_first) core_.leases.restart(now);
  ObjectSet ours;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    const Tenure given{version_of(act.number, 0), act.chair};
    if (!act.given[i] || !is_newer(given, core_.table[i])) continue;
    core_.table.set(i, given);
    // After an act that this peer missed, its objects may have been handed over since.
    ours[i] = act.chair == core_.config.epoch && !is_late;
  }
  if (is_first) leased_ = now;
  rows_.follow_act(lease_end);
  if (!is_voter()) joined_ = now;
  if (!is_voter() && core_.config.votes) {
    core_.table.clear();
    core_.forget_gifts();
  }
  chair_.end();
  rounds_.follow_act(now);
  voting_.follow_act();
  if (ours.any()) {
    core_.counts.adopted += is_first ? 0 : ours.count();
    rows_.gain(ours, is_first ? OwnerChange::founded : OwnerChange::adopted);
  }
}

void Ownership::propose(nanoseconds now) {
  const Proposal* proposal = chair_.step(now);
  if (proposal == nullptr) return;
  const Proposal sent = *proposal;
  core_.send(0, sent);
  if (sent.phase == DecisionPhase::prepare) return;
  if (!voting_.accepts(sent, now)) return voting_.note_threat(sent.act, now);
  accept(sent, now);
  Vote own;
  own.act = sent.act.number;
  own.ballot = sent.ballot;
  receive(own, core_.config.epoch, now);
}

// Steps

void Ownership::step(nanoseconds now) {
  if (started_ == kNever) started_ = now;
  if (stepped_ != kNever && now - stepped_ > kSlept) core_.leases.restart(now);
  stepped_ = now;
  found_if_due(now);
  if (core_.acts.exists()) {
    if (core_.is_informed() && core_.has_lease(now)) leased_ = now;
    voting_.comply(leased_, now);
    propose(now);
    granting_.step(now);
    taking_.step(now);
    core_.is_closing = core_.is_leaving && !granting_.gives_away(now);
  }
  rounds_.step(voting_.complied(), now);
}

bool Ownership::owns(std::size_t object, nanoseconds now) const noexcept {
  if (!rows_.owns(object, now) || voting_.complied() != 0 || core_.is_closing ||
      now - stepped_ > kSlept)
    return false;
  const Act* pending = core_.acts.pending();
  if (pending != nullptr && pending->removes(core_.config.epoch)) return false;
  return core_.is_informed() && core_.has_lease(now);
}

std::size_t Ownership::received_voters(nanoseconds now) const noexcept {
  return static_cast<std::size_t>(
      std::ranges::count_if(core_.acts.decided().roll.voters(), [&](const Voter& voter) {
        return voter.epoch == core_.config.epoch ||
               now - core_.leases.heard_at(voter.epoch) < LeaseBook::kLease;
      }));
}

bool Ownership::has_left() const noexcept {
  const Roll& roll = core_.acts.decided().roll;
  const bool is_alone = is_voter() && roll.size() == 1;
  const bool is_out = !is_voter() && rounds_.is_act_known();
  return core_.is_leaving && (!core_.acts.exists() || is_out || is_alone);
}

}  // namespace reckon::peer

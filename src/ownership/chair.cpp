// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/chair.hpp"

#include <algorithm>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kRepeat = milliseconds(30), kSlowRepeat = milliseconds(200);
constexpr nanoseconds kAttempt = milliseconds(600);   // then a new ballot
constexpr int kMostTries = 3;                         // each longer than the one before
constexpr nanoseconds kStagger = milliseconds(150);   // between voters that repeat a proposal
constexpr nanoseconds kSettled = milliseconds(300);   // of a newcomer, so that more come in one act
constexpr nanoseconds kGone = milliseconds(1500);     // without a round
constexpr nanoseconds kBlocked = milliseconds(2000);  // by a proposal of another voter
constexpr nanoseconds kSuspect = milliseconds(700);

}  // namespace

// Peers that come and go

void Chair::note_newcomer(std::uint32_t epoch, const WorldId& world, nanoseconds now) noexcept {
  const auto known = std::ranges::find(newcomers_, epoch, &Newcomer::epoch);
  Newcomer& row = known != newcomers_.end()
                      ? *known
                      : *std::ranges::min_element(newcomers_, {}, &Newcomer::heard);
  if (row.epoch != epoch || now - row.heard > kGone) row = {epoch, world, now, now};
  row.heard = now;
}

void Chair::note_leaving(std::uint32_t epoch, std::uint32_t act, nanoseconds now) noexcept {
  const auto known = std::ranges::find(leaving_, epoch, &Leaving::epoch);
  Leaving& row =
      known != leaving_.end() ? *known : *std::ranges::min_element(leaving_, {}, &Leaving::heard);
  row = {epoch, act, now};
}

bool Chair::leaves(std::uint32_t epoch, std::uint32_t act, nanoseconds now) const noexcept {
  if (epoch == core_.config.epoch) return core_.is_closing;
  const auto known = std::ranges::find(leaving_, epoch, &Leaving::epoch);
  if (known == leaving_.end() || now - known->heard >= kGone) return false;
  return known->act == kAnyAct || known->act == act;
}

bool Chair::is_preceded(const WorldId& own, nanoseconds now) const noexcept {
  return std::ranges::any_of(newcomers_, [&](const Newcomer& row) {
    return row.epoch != 0 && now - row.heard < kGone && row.world < own;
  });
}

bool Chair::is_dead(std::uint32_t epoch, nanoseconds now) const noexcept {
  if (leaves(epoch, kAnyAct, now)) return true;
  return epoch != core_.config.epoch && now - core_.leases.silent_since(epoch) >= LeaseBook::kDead;
}

bool Chair::is_suspect(std::uint32_t epoch, nanoseconds now) const noexcept {
  return epoch != core_.config.epoch && now - core_.leases.silent_since(epoch) >= kSuspect;
}

// Composing an act

bool Chair::may_propose(nanoseconds now) const noexcept {
  const Act& act = core_.acts.decided();
  if (!act.roll.contains(core_.config.epoch)) return false;
  if (act.chair == core_.config.epoch) return true;
  if (core_.is_closing || !is_dead(act.chair, now)) return false;
  for (const Voter& voter : act.roll.voters()) {
    if (voter.epoch == core_.config.epoch) return true;
    if (!is_dead(voter.epoch, now)) return false;
  }
  return false;
}

std::uint8_t Chair::host_number(const Act& act, std::uint32_t epoch) const {
  const std::uint64_t host = core_.user.host_of(epoch);
  std::array<bool, Roll::kMost + 1> used{};
  for (const Voter& voter : act.roll.voters()) {
    if (core_.user.host_of(voter.epoch) == host) return voter.host;
    used[voter.host] = true;
  }
  return static_cast<std::uint8_t>(std::ranges::find(used, false) - used.begin());
}

// A new voter restarts the silence of all, so it waits while somebody may have failed.
void Chair::add_newcomers(Act& act, nanoseconds now) const {
  for (const Voter& voter : act.roll.voters()) {
    if (is_suspect(voter.epoch, now)) return;
  }
  std::array<Newcomer, Roll::kMost> waiting{};
  std::size_t count = 0;
  for (const Newcomer& row : newcomers_) {
    const bool is_here = row.epoch != 0 && now - row.heard < kSuspect && now - row.since > kSettled;
    if (is_here && !act.roll.contains(row.epoch)) waiting[count++] = row;
  }
  std::sort(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Newcomer& a, const Newcomer& b) { return a.world < b.world; });
  for (std::size_t i = 0; i < count; ++i)
    act.roll.add({waiting[i].epoch, host_number(act, waiting[i].epoch)});
}

// All objects whose owner does not vote, or that were released.
void Chair::give_objects(Act& act) const {
  for (std::size_t i = 0; i < core_.table.size(); ++i)
    act.given[i] = !act.roll.contains(core_.table[i].owner);
}

bool Chair::compose(Act& act, nanoseconds now) const {
  const Act& last = core_.acts.decided();
  act.number = last.number + 1;
  act.roll = last.roll;
  for (const Voter& voter : last.roll.voters()) {
    if (is_dead(voter.epoch, now)) act.remove(voter.epoch);
  }
  act.chair = core_.config.epoch;
  if (core_.is_closing) {
    const auto heir = std::ranges::find_if(
        act.roll.voters(), [&](const Voter& voter) { return !is_suspect(voter.epoch, now); });
    if (heir == act.roll.voters().end()) return false;
    act.chair = heir->epoch;
  }
  if (act.removed_count == 0) add_newcomers(act, now);
  // Until then the former voters may know of an owner that the present ones do not know.
  if (now - core_.leases.restarted() >= LeaseBook::kDead && core_.is_informed()) give_objects(act);
  return act.removed_count > 0 || act.given.any() || act.roll.size() != last.roll.size();
}

// Proposing

void Chair::begin(const Act& wish, nanoseconds now) {
  proposal_ = {};
  proposal_.phase = DecisionPhase::prepare;
  proposal_.world = core_.world;
  proposal_.act.number = core_.acts.decided().number + 1;
  proposal_.ballot = {core_.acts.promised().attempt + 1, core_.config.epoch};
  wish_ = wish;
  best_ = {};
  const Act* pending = core_.acts.pending();
  if (pending != nullptr) wish_ = *pending, best_ = core_.acts.accepted();
  accepted_ = wish_;
  core_.acts.promise(proposal_.ballot);
  vote_count_ = 0;
  is_open_ = true;
  tried_ = now;
  next_ = now;
  restart_ = now + kAttempt * (1 + tries_) + rank(now) * kStagger;
  tries_ = std::min(tries_ + 1, kMostTries);
  begun_ = now;
  add_vote(core_.config.epoch, pending == nullptr);
  propose_if_promised(now);
}

// @param is_free whether it has accepted no act of this number
void Chair::add_vote(std::uint32_t from, bool is_free) noexcept {
  const auto votes = std::span(votes_).first(vote_count_);
  const bool is_known = std::ranges::find(votes, from, &PeerVote::voter) != votes.end();
  if (!is_known && vote_count_ < votes_.size()) votes_[vote_count_++] = {from, is_free};
}

bool Chair::has_majority(const Roll& roll, bool of_free) const noexcept {
  const auto votes = std::span(votes_).first(vote_count_);
  return roll.is_majority([&](const Voter& voter) {
    const auto vote = std::ranges::find(votes, voter.epoch, &PeerVote::voter);
    return vote != votes.end() && (vote->is_free || !of_free);
  });
}

// If a majority has accepted nothing, no act was decided, and any may be proposed. Else it must be
// the accepted one, which the others may refuse for ever; so we wait some time for that majority.
void Chair::propose_if_promised(nanoseconds now) noexcept {
  const Roll& roll = core_.acts.decided().roll;
  const bool is_free = has_majority(roll, true);
  const bool waits =
      best_.proposer != 0 && wish_.hash() != accepted_.hash() && now - begun_ < kAttempt / 2;
  if (!is_free && (waits || !has_majority(roll))) return;
  proposal_.act = is_free ? wish_ : accepted_;
  proposal_.phase = DecisionPhase::propose;
  vote_count_ = 0;
  next_ = {};
}

void Chair::count_promise(const Proposal& promise, std::uint32_t from, nanoseconds now) noexcept {
  const bool is_for_us = is_open_ && proposal_.phase == DecisionPhase::prepare &&
                         promise.act.number == proposal_.act.number;
  if (!is_for_us) return;
  if (promise.ballot != proposal_.ballot) return core_.acts.promise(promise.ballot);
  add_vote(from, promise.accepted.proposer == 0);
  if (promise.accepted.proposer != 0 && promise.accepted > best_) {
    best_ = promise.accepted;
    accepted_ = promise.act;
  }
  propose_if_promised(now);
}

// The number of more senior voters that seem to live.
int Chair::rank(nanoseconds now) const noexcept {
  int rank = 0;
  for (const Voter& voter : core_.acts.decided().roll.voters()) {
    if (voter.epoch == core_.config.epoch) break;
    if (!is_suspect(voter.epoch, now)) ++rank;
  }
  return rank;
}

// The voters repeat an undecided proposal one after the other.
bool Chair::is_my_turn(nanoseconds now) const noexcept {
  if (!core_.acts.decided().roll.contains(core_.config.epoch)) return false;
  return now - tried_ >= kAttempt + (rank(now) + 1) * kStagger;
}

// A voter holds to a proposal that the majority refuses. An act without a change frees it.
bool Chair::pass_over(Act& act, nanoseconds now) const {
  const Act& last = core_.acts.decided();
  const bool is_blocked =
      blocked_ == last.number + 1 && now - blocked_since_ >= kBlocked + rank(now) * kAttempt;
  if (!is_blocked || !last.roll.contains(core_.config.epoch) || !core_.has_lease(now)) return false;
  act = {};
  act.number = last.number + 1;
  act.chair = last.chair;
  act.roll = last.roll;
  return true;
}

const Proposal* Chair::step(nanoseconds now) {
  if (!core_.acts.exists()) return nullptr;
  if (!is_open_ || now >= restart_) {
    Act wish;
    const bool has_pending = core_.acts.pending() != nullptr;
    const bool begins = has_pending
                            ? is_my_turn(now)
                            : (may_propose(now) && compose(wish, now)) || pass_over(wish = {}, now);
    if (!begins) return is_open_ = false, nullptr;
    begin(wish, now);
  }
  if (proposal_.phase == DecisionPhase::prepare) propose_if_promised(now);
  if (now < next_) return nullptr;
  next_ = now + (restart_ - now > kAttempt - 4 * kRepeat ? kRepeat : kSlowRepeat);
  proposal_.digest = core_.table.digest(proposal_.act.given);
  return &proposal_;
}

void Chair::note_other(const Proposal& other, nanoseconds now) noexcept {
  const Roll& roll = core_.acts.decided().roll;
  const bool is_of_senior =
      roll.index_of(other.ballot.proposer) < roll.index_of(core_.config.epoch);
  if (is_of_senior && other.ballot > proposal_.ballot) tried_ = now;
  if (other.act.number != core_.acts.decided().number + 1) return;
  if (blocked_ != other.act.number) blocked_since_ = now;
  blocked_ = other.act.number;
}

bool Chair::count(const Vote& vote, std::uint32_t from) noexcept {
  const bool is_for_us = is_open_ && proposal_.phase == DecisionPhase::propose &&
                         vote.act == proposal_.act.number && vote.ballot == proposal_.ballot;
  if (!is_for_us) return false;
  add_vote(from, true);
  return has_majority(core_.acts.decided().roll) && has_majority(proposal_.act.roll);
}

void Chair::end() noexcept {
  is_open_ = false;
  tries_ = 0;
  blocked_ = 0;
}

}  // namespace reckon::peer

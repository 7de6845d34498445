// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/voting.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kTableAgain = milliseconds(50);
constexpr nanoseconds kThreat = milliseconds(1000);

}  // namespace

bool Voting::accepts_removals(const Act& act, nanoseconds now) const {
  const Act& last = core_.acts.decided();
  for (const Voter& voter : last.roll.voters()) {
    const bool is_removed = !act.roll.contains(voter.epoch);
    if (is_removed != act.removes(voter.epoch)) return false;
    if (!is_removed) continue;
    const bool is_own = voter.epoch == core_.config.epoch;
    const bool agrees = is_own ? rounds_.agrees() : chair_.leaves(voter.epoch, act.number, now);
    const bool is_dead =
        !is_own && now - core_.leases.silent_since(voter.epoch) >= LeaseBook::kDead;
    if (!agrees && !is_dead) return false;
  }
  return act.chair == last.chair || act.removes(last.chair);
}

// An object is given only if its owner is removed or silent, or has released it, and if this peer
// knows of no newer owner than the proposer.
bool Voting::accepts_gifts(const Proposal& proposal, nanoseconds now) {
  const Act& act = proposal.act;
  if (act.given.none()) return true;
  if (now - core_.leases.restarted() < LeaseBook::kDead || !core_.is_informed()) return false;
  for (std::size_t i = 0; i < core_.table.size(); ++i) {
    if (!act.given[i]) continue;
    const std::uint32_t owner = core_.table[i].owner;
    const bool is_silent =
        owner != core_.config.epoch && now - core_.leases.silent_since(owner) >= LeaseBook::kDead;
    if (act.roll.contains(owner) && !is_silent) return false;
  }
  if (core_.table.digest(act.given) == proposal.digest) return true;
  rounds_.send_table(kTableAgain, now);
  return false;
}

bool Voting::accepts(const Proposal& proposal, nanoseconds now) {
  const Act& act = proposal.act;
  if (!core_.acts.may_accept(act, proposal.ballot)) return false;
  const bool is_known = core_.acts.pending() != nullptr && core_.acts.hash() == act.hash() &&
                        core_.acts.pending()->number == act.number;
  if (!act.roll.contains(act.chair)) return false;
  return is_known || (accepts_removals(act, now) && accepts_gifts(proposal, now));
}

// A proposal that we refuse, and that others may have accepted, blocks all later acts. After a
// while we give it what it takes.
void Voting::note_threat(const Act& act, nanoseconds now) noexcept {
  const ObjectSet taken = act.given & rows_.held();
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

void Voting::comply(nanoseconds leased, nanoseconds now) {
  if (const Act* pending = core_.acts.pending()) note_threat(*pending, now);
  const bool is_open = threat_.act == core_.acts.decided().number + 1;
  complies_ = complies_ && is_open;
  // With a lease, a majority is on our side.
  if (!is_open || now - threat_.since < kThreat || now - leased < kThreat) return;
  complies_ = complies_ || threat_.removes;
  const ObjectSet taken = threat_.takes & rows_.held();
  if (taken.any()) rows_.release(taken);
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/owners/audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace reckon::fuzz::owners {
namespace {

using peer::DecisionPhase;
using std::chrono::milliseconds;

// An owner that the voters have not noted stops after a lease and its grace.
constexpr Nanoseconds kNoted = peer::LeaseBook::kDead;
constexpr Nanoseconds kLeaseGap = milliseconds(20);  // between two checks of a peer's lease

}  // namespace

void Audit::find(int invariant, Nanoseconds now, std::string sentence) {
  if (outcome_.finding) return;
  outcome_.finding = Finding{invariant, now, std::move(sentence)};
}

void Audit::note_round(std::uint32_t to, std::uint32_t from, Nanoseconds sent) {
  Nanoseconds& last = received_[slot_of(to)][slot_of(from)];
  last = std::max(last, sent);
}

void Audit::note(std::size_t peer, Nanoseconds now) {
  const peer::Ownership& protocol = owners_[peer].protocol();
  for (const peer::OwnershipEvent& event : protocol.events()) note_event(peer, event, now);
  for (const peer::OutgoingMessage& out : protocol.outgoing()) {
    if (const auto* round = std::get_if<peer::Round>(&out.message)) {
      note_message(peer, *round, now);
    } else if (const auto* proposal = std::get_if<peer::Proposal>(&out.message)) {
      note_message(peer, *proposal, now);
    } else if (const auto* vote = std::get_if<peer::Vote>(&out.message)) {
      note_message(peer, *vote, now);
    } else if (const auto* agreement = std::get_if<peer::Agreement>(&out.message)) {
      note_agreement(peer, out.to, *agreement, now);
    }
  }
  if (protocol.world() != lives_[peer].world ||
      protocol.acts().decided().number != lives_[peer].act)
    note_decided(peer, now);
}

// If all faults are leaves, a peer gives all objects away before it agrees to its removal.
void Audit::note_message(std::size_t peer, const peer::Round& round, Nanoseconds now) {
  if (round.yields_to == 0) return;
  lives_[peer].yields = true;
  if (!plan_.leaves_only) return;
  for (std::size_t i = 0; i < plan_.objects; ++i) {
    if (owners_[peer].protocol().tenure(i).owner == owners_[peer].epoch())
      find(11, now, fmt::format("peer {} leaves and keeps object {}", peer, i));
  }
}

// Decisions

void Audit::note_message(std::size_t peer, const peer::Proposal& proposal, Nanoseconds now) {
  const peer::ActBook& acts = owners_[peer].protocol().acts();
  const std::uint32_t number = proposal.act.number;
  Life& life = lives_[peer];
  if (proposal.phase == DecisionPhase::decided) return;
  peer::Ballot& promised = life.promised[{proposal.world, number}];
  promised = std::max(promised, proposal.ballot);
  if (proposal.phase != DecisionPhase::propose) return;
  Decision& decision = decisions_[{proposal.world, number}];
  const std::uint32_t hash = proposal.act.hash();
  decision.proposals.try_emplace(proposal.ballot, Proposed{hash, {}});
  if (decision.ballot.proposer != 0 && proposal.ballot > decision.ballot && hash != decision.chosen)
    find(7, now,
         fmt::format("peer {} proposes another act {} than a majority has accepted", peer, number));
  const bool is_pending = acts.pending() != nullptr && acts.hash() == hash;
  const bool is_own =
      acts.decided().number == number || (is_pending && proposal.ballot >= acts.promised());
  if (is_own) add_vote(peer, number, proposal.ballot, now);
}

void Audit::note_message(std::size_t peer, const peer::Vote& vote, Nanoseconds now) {
  const auto promised = lives_[peer].promised.find({vote.world, vote.act});
  if (promised != lives_[peer].promised.end() && vote.ballot < promised->second)
    find(7, now, fmt::format("peer {} accepts a lower ballot than it has promised", peer));
  add_vote(peer, vote.act, vote.ballot, now);
}

void Audit::add_vote(std::size_t peer, std::uint32_t act, const peer::Ballot& ballot,
                     Nanoseconds now) {
  const peer::Ownership& protocol = owners_[peer].protocol();
  Decision& decision = decisions_[{protocol.world(), act}];
  const auto proposed = decision.proposals.find(ballot);
  if (proposed == decision.proposals.end()) return;
  const std::size_t slot = slot_of(owners_[peer].epoch());
  const std::uint32_t hash = proposed->second.hash;
  const bool is_known = std::ranges::any_of(decision.proposals, [&](const auto& other) {
    return other.second.hash == hash && other.second.voters[slot];
  });
  proposed->second.voters.set(slot);
  const peer::Act* pending = protocol.acts().pending();
  if (!is_known && pending != nullptr) look_at_gifts(peer, *pending, ballot.proposer, now);
  const auto former = decisions_.find({protocol.world(), act - 1});
  const bool is_chosen = former != decisions_.end() && former->second.is_decided &&
                         is_majority(former->second.roll, proposed->second.voters);
  if (!is_chosen || decision.ballot.proposer != 0) return;
  decision.chosen = hash;
  decision.ballot = ballot;
}

// A voter accepts no gift of an object if it knows a newer owner than the proposer.
void Audit::look_at_gifts(std::size_t peer, const peer::Act& act, std::uint32_t proposer,
                          Nanoseconds now) {
  const SimulatedOwner& other = owners_[SimulatedOwner::index_of(proposer)];
  const bool is_comparable = other.epoch() == proposer && other.protocol().is_informed() &&
                             other.protocol().acts().newest().number == act.number;
  if (!is_comparable) return;
  for (std::size_t i = 0; i < plan_.objects; ++i) {
    if (act.given[i] &&
        peer::is_newer(owners_[peer].protocol().tenure(i), other.protocol().tenure(i)))
      find(7, now,
           fmt::format("peer {} accepts a gift of object {}, and knows a newer owner", peer, i));
  }
}

void Audit::note_decided(std::size_t peer, Nanoseconds now) {
  const peer::Ownership& protocol = owners_[peer].protocol();
  const peer::Act& act = protocol.acts().decided();
  Life& life = lives_[peer];
  const bool is_same_world = life.world == protocol.world();
  life.world = protocol.world();
  life.act = act.number;
  for (std::size_t i = 0; i < plan_.objects; ++i) {
    if (!is_same_world) life.noted[i] = {};
    if (is_same_world && peer::act_of(protocol.tenure(i).version) != act.number)
      life.noted[i] = {now, {}};
  }
  if (act.number == 0) return;
  Decision& decision = decisions_[{life.world, act.number}];
  const std::uint32_t hash = act.hash();
  if (decision.is_decided && decision.decided != hash)
    find(7, now, fmt::format("peer {} decides another act {}", peer, act.number));
  if (decision.is_decided) return;
  decision.is_decided = true;
  decision.decided = hash;
  decision.roll = act.roll;
  const auto former = decisions_.find({life.world, act.number - 1});
  if (former != decisions_.end()) look_at_decision(peer, former->second.roll, now);
}

void Audit::look_at_decision(std::size_t peer, const peer::Roll& former, Nanoseconds now) {
  const peer::Act& act = owners_[peer].protocol().acts().decided();
  const Decision& decision = decisions_[{lives_[peer].world, act.number}];
  const bool is_accepted = std::ranges::any_of(decision.proposals, [&](const auto& proposal) {
    const Proposed& proposed = proposal.second;
    return proposed.hash == decision.decided && is_majority(former, proposed.voters) &&
           is_majority(act.roll, proposed.voters);
  });
  if (!is_accepted) find(7, now, fmt::format("act {} is decided without a majority", act.number));
  for (const std::uint32_t epoch : act.removed()) {
    const std::size_t index = SimulatedOwner::index_of(epoch);
    const Life& life = lives_[index];
    const bool is_there = owners_[index].epoch() == epoch && life.world == lives_[peer].world;
    if (is_there && !life.yields && now - life.owned < peer::LeaseBook::kGrace)
      find(8, now, fmt::format("peer {} is removed soon after its lease", index));
  }
}

// Owners

void Audit::note_event(std::size_t peer, const peer::OwnershipEvent& event, Nanoseconds now) {
  if (event.kind != peer::OwnershipEvent::Kind::gained) return;
  if (event.cause == peer::OwnerChange::returned) return;
  const bool is_granted = event.cause == peer::OwnerChange::granted;
  for (std::size_t i = 0; i < plan_.objects; ++i) {
    if (event.objects[i]) lives_[peer].noted[i] = {is_granted ? now : Nanoseconds::max(), {}};
  }
}

void Audit::note_agreement(std::size_t peer, std::uint32_t to, const peer::Agreement& agreement,
                           Nanoseconds now) {
  if (!owners_[peer].protocol().is_informed())
    find(10, now, fmt::format("peer {} notes an owner, and has missed an act", peer));
  const std::size_t index = SimulatedOwner::index_of(to);
  if (owners_[index].epoch() != to) return;
  const peer::Act* pending = owners_[peer].protocol().acts().pending();
  for (std::size_t i = 0; i < plan_.objects; ++i) {
    if (!agreement.objects[i]) continue;
    lives_[index].noted[i].voters.set(slot_of(owners_[peer].epoch()));
    if (pending != nullptr && (pending->given[i] || pending->removes(to)))
      find(10, now, fmt::format("peer {} notes an owner that an accepted act replaces", peer));
  }
}

void Audit::note_owner(std::size_t peer, std::size_t object, Nanoseconds now) {
  Life& life = lives_[peer];
  life.owned = now;
  const peer::ActBook& acts = owners_[peer].protocol().acts();
  const std::uint32_t own = owners_[peer].epoch();
  const Noted& noted = life.noted[object];
  if (noted.since < now - kNoted) {
    Voters voters = noted.voters;
    voters.set(slot_of(own));
    if (!is_majority(acts.decided().roll, voters))
      find(10, now, fmt::format("peer {} owns object {}, and no majority notes it", peer, object));
  }
  if (now - life.checked < kLeaseGap) return;
  life.checked = now;
  const auto receives = [&](const peer::Voter& voter) {
    return voter.epoch == own ||
           received_[slot_of(voter.epoch)][slot_of(own)] >= now - peer::LeaseBook::kLease;
  };
  const bool is_leased = acts.decided().roll.is_majority(receives) &&
                         (acts.pending() == nullptr || acts.pending()->roll.is_majority(receives));
  if (!is_leased) find(8, now, fmt::format("peer {} owns object {} without a lease", peer, object));
}

}  // namespace reckon::fuzz::owners

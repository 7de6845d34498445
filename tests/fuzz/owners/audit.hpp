// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The invariants of ownership that need the messages: I7 decisions, I8 leases, I10 noted owners,
// I11 leavers.
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/owners/plan.hpp"
#include "reckon/tests/fuzz/owners/simulated_owner.hpp"
#include "reckon/tests/fuzz/search/seeded_simulation.hpp"

namespace reckon::fuzz::owners {

/// Reads what the peers send, receive and report. Compares it with what they own and decide.
class Audit {
 public:
  Audit(const Plan& plan, const std::vector<SimulatedOwner>& owners, SeededOutcome<>& outcome)
      : plan_(plan), owners_(owners), outcome_(outcome) {}

  /// A peer has a new life.
  void note_start(std::size_t peer) { lives_[peer] = Life(plan_.objects); }
  /// A peer has received a round of another one.
  void note_round(std::uint32_t to, std::uint32_t from, Nanoseconds sent);
  /// A peer has stepped or received something: its events and messages.
  void note(std::size_t peer, Nanoseconds now);
  /// A peer owns an object.
  void note_owner(std::size_t peer, std::size_t object, Nanoseconds now);

 private:
  static constexpr std::size_t kLives = 16;  // of a peer
  static constexpr std::size_t kSlots = 8 * kLives;
  static constexpr Nanoseconds kNever = Nanoseconds::min() / 4;
  using Voters = std::bitset<kSlots>;

  struct Proposed {
    std::uint32_t hash = 0;
    Voters voters;
  };
  // The decision on one act.
  struct Decision {
    std::map<peer::Ballot, Proposed> proposals;
    std::uint32_t chosen = 0;   // hash of what a majority of the former voters has accepted ..
    peer::Ballot ballot;        // .. with this ballot; proposer 0: none
    std::uint32_t decided = 0;  // hash
    peer::Roll roll;            // of the decided act
    bool is_decided = false;
  };
  struct Noted {
    Nanoseconds since = Nanoseconds::max();  // when voters were first asked; max: they need not
    Voters voters;
  };
  struct Life {
    explicit Life(std::size_t objects) : noted(objects) {}
    peer::WorldId world;
    std::uint32_t act = 0;
    std::map<std::pair<peer::WorldId, std::uint32_t>, peer::Ballot> promised;  // by act
    Nanoseconds owned = kNever, checked = kNever;
    bool yields = false;  // agrees to its removal
    std::vector<Noted> noted;
  };

  static std::vector<std::array<Nanoseconds, kSlots>> never_received() {
    std::array<Nanoseconds, kSlots> row;
    row.fill(kNever);
    return std::vector(kSlots, row);
  }
  static std::size_t slot_of(std::uint32_t epoch) {
    return SimulatedOwner::index_of(epoch) * kLives + epoch % 1000 % kLives;
  }
  static bool is_majority(const peer::Roll& roll, const Voters& voters) {
    return roll.is_majority([&](const peer::Voter& voter) { return voters[slot_of(voter.epoch)]; });
  }
  void find(int invariant, Nanoseconds now, std::string sentence);
  void note_event(std::size_t peer, const peer::OwnershipEvent& event, Nanoseconds now);
  void note_message(std::size_t peer, const peer::Round& round, Nanoseconds now);
  void note_message(std::size_t peer, const peer::Proposal& proposal, Nanoseconds now);
  void note_message(std::size_t peer, const peer::Vote& vote, Nanoseconds now);
  void note_agreement(std::size_t peer, std::uint32_t to, const peer::Agreement& agreement,
                      Nanoseconds now);
  void note_decided(std::size_t peer, Nanoseconds now);
  void add_vote(std::size_t peer, std::uint32_t act, const peer::Ballot& ballot, Nanoseconds now);
  void look_at_gifts(std::size_t peer, const peer::Act& act, std::uint32_t proposer,
                     Nanoseconds now);
  void look_at_decision(std::size_t peer, const peer::Roll& former, Nanoseconds now);

  const Plan& plan_;
  const std::vector<SimulatedOwner>& owners_;
  SeededOutcome<>& outcome_;
  std::vector<Life> lives_ = std::vector<Life>(plan_.peers, Life(plan_.objects));
  // Sending time of the last round, by receiver and sender.
  std::vector<std::array<Nanoseconds, kSlots>> received_ = never_received();
  std::map<std::pair<peer::WorldId, std::uint32_t>, Decision> decisions_;
};

}  // namespace reckon::fuzz::owners

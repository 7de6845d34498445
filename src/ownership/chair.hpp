// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Proposes acts: new voters, the removal of failed ones, and a new owner for their objects.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/peer/ownership/ownership_core.hpp"

namespace reckon::peer {

/// A peer without an act that wants to vote.
struct Newcomer {
  std::uint32_t epoch = 0;
  WorldId world;  ///< that it would found
  std::chrono::nanoseconds since{0}, heard{0};
};

/// Only the chair proposes acts; if it has failed, the most senior voter that lives. Any voter
/// repeats a proposal that was accepted and not decided. One thread; no allocation.
class Chair {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  explicit Chair(OwnershipCore& core) : core_(core) {}

  /// A peer without an act has sent a round.
  void note_newcomer(std::uint32_t epoch, const WorldId& world, Nanoseconds now) noexcept;
  void forget_newcomers() noexcept { newcomers_.fill({}); }
  /// A voter agrees to be removed by the act with this number; kAnyAct: it leaves.
  void note_leaving(std::uint32_t epoch, std::uint32_t act, Nanoseconds now) noexcept;
  /// Whether this voter agrees to be removed by that act.
  [[nodiscard]] bool leaves(std::uint32_t epoch, std::uint32_t act, Nanoseconds now) const noexcept;
  /// Whether another peer would found an older world than this.
  [[nodiscard]] bool is_preceded(const WorldId& own, Nanoseconds now) const noexcept;

  /// A vote for our proposal. True if it decides the act.
  [[nodiscard]] bool count(const Vote& vote, std::uint32_t from) noexcept;
  /// A promise for our proposal, or a refusal.
  void count_promise(const Proposal& promise, std::uint32_t from, Nanoseconds now) noexcept;
  /// Another voter proposes an act of this number.
  void note_other(const Proposal& other, Nanoseconds now) noexcept;
  /// Our proposal, if it is due; null if none is.
  [[nodiscard]] const Proposal* step(Nanoseconds now);
  [[nodiscard]] const Proposal& proposal() const noexcept { return proposal_; }
  /// An act was decided or the world has changed.
  void end() noexcept;

 private:
  struct PeerVote {
    std::uint32_t voter = 0;  // epoch
    bool is_free = false;     // it has accepted no act of this number
  };
  struct Leaving {
    std::uint32_t epoch = 0;
    std::uint32_t act = 0;
    Nanoseconds heard{0};
  };
  [[nodiscard]] bool is_dead(std::uint32_t epoch, Nanoseconds now) const noexcept;
  [[nodiscard]] bool is_suspect(std::uint32_t epoch, Nanoseconds now) const noexcept;
  [[nodiscard]] bool may_propose(Nanoseconds now) const noexcept;
  [[nodiscard]] bool pass_over(Act& act, Nanoseconds now) const;
  [[nodiscard]] bool compose(Act& act, Nanoseconds now) const;
  void add_newcomers(Act& act, Nanoseconds now) const;
  void give_objects(Act& act) const;
  [[nodiscard]] std::uint8_t host_number(const Act& act, std::uint32_t epoch) const;
  void begin(const Act& wish, Nanoseconds now);
  void add_vote(std::uint32_t from, bool is_free) noexcept;
  [[nodiscard]] bool has_majority(const Roll& roll, bool of_free = false) const noexcept;
  void propose_if_promised(Nanoseconds now) noexcept;
  [[nodiscard]] int rank(Nanoseconds now) const noexcept;
  [[nodiscard]] bool is_my_turn(Nanoseconds now) const noexcept;

  OwnershipCore& core_;
  std::array<Newcomer, Roll::kMost> newcomers_{};
  std::array<Leaving, Roll::kMost> leaving_{};
  Proposal proposal_;
  Act wish_;      // to be proposed, unless another may be decided
  Act accepted_;  // that other one ..
  Ballot best_;   // .. and its ballot; proposer 0: none
  bool is_open_ = false;
  Nanoseconds next_{0}, restart_{0}, begun_{0};
  int tries_ = 0;         // of this act
  Nanoseconds tried_{0};  // last ballot, of any voter
  std::array<PeerVote, 2 * Roll::kMost> votes_{};
  std::size_t vote_count_ = 0;
  std::uint32_t blocked_ = 0;  // number of an act that another voter proposes ..
  Nanoseconds blocked_since_{0};
};

}  // namespace reckon::peer

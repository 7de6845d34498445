// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which proposals this peer accepts as a voter.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/peer/ownership/chair.hpp"
#include "reckon/peer/ownership/object_rows.hpp"
#include "reckon/peer/ownership/rounds.hpp"

namespace reckon::peer {

/// One thread; no allocation.
class Voting {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  Voting(OwnershipCore& core, ObjectRows& rows, Rounds& rounds, const Chair& chair)
      : core_(core), rows_(rows), rounds_(rounds), chair_(chair) {}

  [[nodiscard]] bool accepts(const Proposal& proposal, Nanoseconds now);
  /// Notes a proposal that was not accepted.
  void note_threat(const Act& act, Nanoseconds now) noexcept;
  /// Gives up what such a proposal takes, if there is no majority without its voters.
  /// @param leased last time with a lease
  void comply(Nanoseconds leased, Nanoseconds now);
  /// Number of the act that may remove this peer; 0: none.
  [[nodiscard]] std::uint32_t complied() const noexcept { return complies_ ? threat_.act : 0; }
  /// An act was decided.
  void follow_act() noexcept {
    complies_ = false;
    threat_ = {};
  }

 private:
  /// Proposed acts of one number that remove this peer or take its objects.
  struct Threat {
    std::uint32_t act = 0;
    Nanoseconds since{0}, seen{0};
    bool removes = false;
    ObjectSet takes;
  };

  [[nodiscard]] bool accepts_removals(const Act& act, Nanoseconds now) const;
  [[nodiscard]] bool accepts_gifts(const Proposal& proposal, Nanoseconds now);

  OwnershipCore& core_;
  ObjectRows& rows_;
  Rounds& rounds_;
  const Chair& chair_;
  Threat threat_;
  bool complies_ = false;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The last decided act, and the next one as far as this peer has accepted it.
#pragma once

#include <cstdint>
#include <optional>

#include "reckon/peer/ownership/act.hpp"

namespace reckon::peer {

/// A voter's part in the decision on the next act, as in Paxos. A proposer asks a majority for
/// promises. If some name an accepted act, it proposes the one of the highest ballot, else its own.
/// So at most one act of each number is decided. One thread; no allocation.
class ActBook {
 public:
  [[nodiscard]] bool exists() const noexcept { return decided_.number > 0; }
  /// Number 0 if there is none.
  [[nodiscard]] const Act& decided() const noexcept { return decided_; }
  /// The accepted next act; null if there is none, or it is decided.
  [[nodiscard]] const Act* pending() const noexcept { return pending_ ? &*pending_ : nullptr; }
  /// Ballot of the accepted next act.
  [[nodiscard]] const Ballot& accepted() const noexcept { return accepted_; }
  /// The highest ballot that this peer has promised to or seen; lower ones are refused.
  [[nodiscard]] const Ballot& promised() const noexcept { return promised_; }

  /// The accepted next act, or the decided one.
  [[nodiscard]] const Act& newest() const noexcept { return pending_ ? *pending_ : decided_; }
  /// Its hash.
  [[nodiscard]] std::uint32_t hash() const noexcept { return hash_; }

  /// Whether a proposal of the next act may be accepted, as far as ballots decide.
  [[nodiscard]] bool may_accept(const Act& act, const Ballot& ballot) const noexcept;
  void accept(const Act& act, const Ballot& ballot) noexcept;
  /// Refuses lower ballots from now on.
  void promise(const Ballot& ballot) noexcept;
  /// A decided act. False if it is not newer than ours.
  bool decide(const Act& act) noexcept;
  void clear() noexcept { *this = {}; }

 private:
  Act decided_;
  std::optional<Act> pending_;
  Ballot accepted_, promised_;
  std::uint32_t hash_ = 0;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/act_book.hpp"

#include <algorithm>

namespace reckon::peer {

bool ActBook::may_accept(const Act& act, const Ballot& ballot, const Ballot& seen) const noexcept {
  if (!exists() || act.number != decided_.number + 1) return false;
  return ballot >= promised_ && (!pending_ || accepted_ <= seen || hash_ == act.hash());
}

void ActBook::accept(const Act& act, const Ballot& ballot) noexcept {
  pending_ = act;
  accepted_ = ballot;
  promised_ = std::max(promised_, ballot);
  hash_ = act.hash();
}

void ActBook::note_ballot(const Ballot& ballot) noexcept {
  promised_ = std::max(promised_, ballot);
}

bool ActBook::decide(const Act& act) noexcept {
  if (act.number <= decided_.number) return false;
  decided_ = act;
  hash_ = act.hash();
  pending_.reset();
  accepted_ = promised_ = {};
  return true;
}

}  // namespace reckon::peer

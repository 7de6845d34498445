// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/act_book.hpp"

#include <algorithm>

namespace reckon::peer {

bool ActBook::may_accept(const Act& act, const Ballot& ballot) const noexcept {
  return exists() && act.number == decided_.number + 1 && ballot >= promised_;
}

void ActBook::accept(const Act& act, const Ballot& ballot) noexcept {
  pending_ = act;
  accepted_ = ballot;
  promised_ = std::max(promised_, ballot);
  hash_ = act.hash();
}

void ActBook::promise(const Ballot& ballot) noexcept { promised_ = std::max(promised_, ballot); }

bool ActBook::decide(const Act& act) noexcept {
  if (act.number <= decided_.number) return false;
  decided_ = act;
  hash_ = act.hash();
  pending_.reset();
  accepted_ = promised_ = {};
  return true;
}

}  // namespace reckon::peer

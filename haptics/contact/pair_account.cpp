// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/pair_account.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kGreatestTotal = 1e6;     // [J], a larger total is invalid
constexpr double kGreatestBelieved = 0.1;  // [J], bound of |believed|

}  // namespace

void PairAccount::open(const pdu::EntityId& whose, std::uint32_t life, double total) noexcept {
  if (used && id == whose) return;
  *this = PairAccount{};
  id = whose;
  used = true;
  epoch = life;
  stated = seen = std::isfinite(total) ? std::max(0.0, total) : 0.0;
}

void PairAccount::receive(std::uint32_t life, double total) noexcept {
  const bool sound = std::isfinite(total) && total >= 0 && total <= kGreatestTotal;
  if (life != epoch) {
    epoch = life;
    seen = stated = sound ? total : kGreatestTotal;
  } else if (sound) {
    stated = std::max(stated, total);
  }
}

void PairAccount::claim(EnergyLedger& ledger) noexcept {
  const double claimed = std::min(stated - seen, ledger.receivable());
  if (!(claimed > 0)) return;
  const double fits = ledger.credit(claimed, std::max(0.0, believed));
  received += fits;
  believed -= fits;
  seen += claimed;
}

void PairAccount::see(double work) noexcept {
  believed = std::clamp(believed + work, -kGreatestBelieved, kGreatestBelieved);
}

double PairAccount::give(EnergyLedger& ledger, double wanted) noexcept {
  const double gift = ledger.give(wanted);
  given += gift;
  believed += gift;
  return gift;
}

}  // namespace reckon::haptics

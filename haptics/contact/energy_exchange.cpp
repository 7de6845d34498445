// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/energy_exchange.hpp"

#include <algorithm>

#include "reckon/haptics/passivity/energy_demand.hpp"

namespace reckon::haptics {
namespace {

constexpr double kSpringSpare = 1e-4;  // [J], wanted beyond the springs' storage
constexpr double kMostAsked = 0.06;    // [J], from one neighbour

// Sums over all engaged contacts.
struct Wants {
  std::size_t engaged = 0;
  Eigen::Vector3d shown = Eigen::Vector3d::Zero();   // [N], sum: opposite forces cancel
  Eigen::Vector3d coming = Eigen::Vector3d::Zero();  // [N], sum of coming_force()
  double inside_force = 0.0;                         // [N], greatest of contacts that began inside
  double of_hands = 0.0;                             // [N], greatest of the hands
  double stored = 0.0;                               // [J]
  double asked = 0.0;                                // [J], requested of us
};

Wants wants_of(std::span<RemoteContact* const> near) noexcept {
  Wants out;
  for (const RemoteContact* remote : near) {
    if (!remote->engaged()) continue;
    ++out.engaged;
    out.asked += remote->asked();
    out.shown += remote->spring().force();
    out.coming += remote->coming_force();
    const double greatest = remote->greatest_force();
    if (remote->is_hand()) out.of_hands = std::max(out.of_hands, greatest);
    if (remote->began_inside()) out.inside_force = std::max(out.inside_force, greatest);
    out.stored += remote->greatest_store();
  }
  return out;
}

// @param inside energy needed by contacts that began inside [J]
void settle_loan(EnergyLedger& ledger, const EnergyDemand& own, double inside,
                 const PortNeeds& needs) noexcept {
  if (own.surplus() > 0) {
    ledger.pay_back(own.surplus());
    return;
  }
  const bool hands = inside > 0 && needs.speed <= kCalm;
  const double power = (needs.walls > 0 ? kWallLoanPower : 0.0) + (hands ? kHandLoanPower : 0.0);
  const double most = needs.walls > 0 ? kGreatestLoan : kGreatestHandLoan;
  const double lacks = std::max(0.0, needs.walls + inside - own.level);
  ledger.borrow(std::min({std::max(0.0, most - ledger.owed()), power * needs.dt, lacks}));
}

}  // namespace

std::size_t exchange_energy(std::span<RemoteContact* const> near, EnergyLedger& ledger,
                            const PortNeeds& needs) noexcept {
  const Wants wants = wants_of(near);
  EnergyDemand own;
  own.level = ledger.level();
  own.full =
      needs.walls + first_tier(std::max(wants.shown.norm(), wants.coming.norm()), needs.spare);
  own.spring = wants.stored + kSpringSpare;
  const double force = std::max(wants.inside_force, needs.at_rest ? wants.of_hands : 0.0);
  const double inside = force > 0 ? first_tier(force, needs.spare) : 0.0;
  settle_loan(ledger, own, inside, needs);
  own.level = ledger.level();

  for (RemoteContact* remote : near) {
    remote->give_for_a_blow(ledger, own, needs.dt);
    remote->answer(ledger, own, needs.spare, wants.asked > remote->asked());
  }
  const auto others = static_cast<double>(wants.engaged);
  const double surplus = std::max(0.0, own.surplus());
  for (RemoteContact* remote : near) {
    if (!remote->engaged()) {
      remote->ask(0.0, 0.0);
      continue;
    }
    const double passed_on = std::max(0.0, wants.asked - remote->asked() - surplus);
    remote->ask(std::min(kMostAsked, own.need() / others + passed_on), own.spring_need() / others);
  }
  return wants.engaged;
}

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Decides when the felt side of an entity of ours has to be sent.
#include <algorithm>
#include <cmath>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/owned_entity.hpp"

namespace reckon::peer {
namespace {

// Energy below this is too small for a packet [J]: 0.045 N of a 500 N/m contact. A full ledger
// holds 0.02.
// 0.02.
constexpr double kSmallEnergy = 2e-6;
// A need is sent again when it has changed by this share.
constexpr double kNeedChange = 0.25;

}  // namespace

TouchSide::Miss TouchSide::worst_miss(const deadreckon::Pose& truth, double now,
                                      std::span<const deadreckon::ProbeState> probes,
                                      const deadreckon::Thresholds& limits) const noexcept {
  if (limits.weber <= 0) return {predictor_.error(model_, truth, probes, now), 0};
  const auto share = [&](const Miss& miss) {
    return miss.error / std::max(limits.force, limits.weber * miss.truth);
  };
  Miss worst;
  for (const deadreckon::ProbeState& probe : probes) {
    const Miss miss{predictor_.error(model_, truth, std::span(&probe, 1), now),
                    deadreckon::evaluate(model_, truth, probe).norm()};
    if (!(share(miss) <= share(worst))) worst = miss;
  }
  return worst;
}

double TouchSide::point_miss(const deadreckon::Pose& truth, double now) const noexcept {
  const deadreckon::Pose shown = predictor_.entity(now);
  const Eigen::Vector3d stated = shown.position + shown.orientation * predictor_.model().point;
  return (stated - truth.position - truth.orientation * model_.point).norm();
}

bool TouchSide::accounts_changed(std::span<const EnergyAccount> accounts) const noexcept {
  const std::span<const pdu::EnergyAccountRecord> sent(sent_.data(), sent_count_);
  return std::any_of(accounts.begin(), accounts.end(), [&](const EnergyAccount& now) {
    if (now.counterpart == aoim::kAllBodies) return false;  // goes with the motion
    const auto before = std::find_if(sent.begin(), sent.end(), [&](const auto& record) {
      return record.counterpart == now.counterpart;
    });
    const double given = before == sent.end() ? 0.0 : before->given;
    const double need = before == sent.end() ? 0.0 : pdu::from_microjoules(before->need);
    if (now.given - given > kSmallEnergy) return true;
    const double wish = before == sent.end() ? 0.0 : pdu::from_microjoules(before->spring_need);
    const auto changed = [](double wanted, double stated) {
      const double change = std::abs(wanted - stated);
      return change > kSmallEnergy && change > kNeedChange * std::max(wanted, stated);
    };
    return changed(now.need, need) || changed(now.spring_need, wish);
  });
}

}  // namespace reckon::peer

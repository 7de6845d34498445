// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/energy_demand.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kMargin = 1.3;            // of the first tier
constexpr double kSpare = 2e-4;            // [J], added to it
constexpr double kSpringPart = 0.2;        // of half the difference of second tiers, at once
constexpr double kFarPart = 0.2;           // of an equal share, if answers come late
constexpr double kGreatestRequest = 0.06;  // [J]

// Energy that gives both sides the same share of their needs.
double equal_share(const EnergyRequest& request, double shortage,
                   const EnergyDemand& own) noexcept {
  const double full = std::max(request.most, shortage);
  if (!(full + own.full > 0)) return 0.0;
  const double level = std::max(0.0, own.level);
  return std::min(shortage, (level * full - (full - shortage) * own.full) / (full + own.full));
}

}  // namespace

double first_tier(double force, double spare) noexcept {
  if (!(spare > 0)) return 0.0;
  return kMargin * force * force / (4.0 * spare) + kSpare;
}

double gift(const EnergyRequest& request, const EnergyDemand& own) noexcept {
  const auto sound = [](double value) {
    return std::isfinite(value) ? std::clamp(value, 0.0, kGreatestRequest) : 0.0;
  };
  const double need = sound(request.need);
  const double spring_need = sound(request.spring_need);
  const double surplus = std::max(0.0, own.surplus());
  double first = std::min(request.contested ? std::min(need, request.share) : need, surplus);
  if (own.surplus() < need) {
    const double shared =
        std::min(request.most, equal_share(request, std::min(need, request.share), own));
    first = std::max(first, (request.near ? 1.0 : kFarPart) * shared);
  }
  double second = 0.0;
  if (spring_need > 0) {
    second = kSpringPart * std::max(0.0, 0.5 * (own.spring_surplus() + spring_need));
    second = std::min(second, surplus);
  }
  return std::max({0.0, first, second});
}

}  // namespace reckon::haptics

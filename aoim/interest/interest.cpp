// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/interest.hpp"

#include <algorithm>
#include <utility>

namespace reckon::aoim {

Interest::Interest(const InterestConfig& config) : config_(config) {
  foci_.reserve(config.maximum_foci);
}

std::size_t Interest::set_foci(std::span<const Focus> foci) noexcept {
  foci_.clear();
  for (const Focus& focus : foci) {
    const bool usable = is_finite(focus.position) && focus.radius >= 0.0;
    if (usable && foci_.size() < config_.maximum_foci) foci_.push_back(focus);
  }
  return foci_.size();
}

InterestVerdict Interest::verdict(const Position& position, double nimbus, std::uint8_t kind,
                                  bool shown) noexcept {
  if (kind < 32 && (config_.kinds >> kind & 1u) == 0) return InterestVerdict::class_off;
  if (!is_finite(position) || !std::isfinite(nimbus)) return InterestVerdict::not_finite;

  bool lingers = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Focus& focus : foci_) {
    const double away = distance(position, focus.position) - nimbus;
    if (away <= focus.radius) return InterestVerdict::inside;
    nearest = std::min(nearest, away);
    lingers = lingers || away <= config_.leave_factor * focus.radius;
  }
  if (!shown) {
    nearest_outside_ = std::min(nearest_outside_, nearest);
    return InterestVerdict::outside;
  }
  return lingers ? InterestVerdict::lingering : InterestVerdict::left;
}

double Interest::gap(const Position& position, double nimbus) const noexcept {
  double nearest = std::numeric_limits<double>::infinity();
  if (!is_finite(position)) return nearest;
  for (const Focus& focus : foci_) {
    nearest = std::min(nearest, distance(position, focus.position) - nimbus - focus.radius);
  }
  return nearest;
}

double Interest::fastest_focus() const noexcept {
  double fastest = 0.0;
  for (const Focus& focus : foci_) fastest = std::max(fastest, focus.speed);
  return fastest;
}

double Interest::take_nearest_outside() noexcept {
  return std::exchange(nearest_outside_, std::numeric_limits<double>::infinity());
}

InterestVerdict Interest::judge(const Position& position, double nimbus, std::uint8_t kind,
                                bool shown) noexcept {
  const InterestVerdict result = verdict(position, nimbus, kind, shown);
  switch (result) {
    case InterestVerdict::inside:
      ++counts_.accepted;
      break;
    case InterestVerdict::lingering:
      ++counts_.lingering;
      break;
    case InterestVerdict::left:
      ++counts_.left;
      break;
    case InterestVerdict::outside:
      ++counts_.outside;
      break;
    case InterestVerdict::class_off:
      ++counts_.class_off;
      break;
    case InterestVerdict::not_finite:
      ++counts_.not_finite;
      break;
  }
  return result;
}

}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/interest.hpp"

#include <algorithm>
#include <utility>

namespace reckon::aoim {

Interest::Interest(const InterestConfig& config)
    : config_(config),
      occluders_(config.occluders),
      asks_more_(std::isfinite(config.aura) || !config.occluders.empty()) {
  foci_.reserve(config.maximum_foci);
  former_.reserve(config.maximum_foci);
}

std::size_t Interest::set_foci(std::span<const Focus> foci) noexcept {
  std::swap(foci_, former_);
  foci_.clear();
  double least = std::numeric_limits<double>::infinity();
  for (const Focus& focus : foci) {
    const bool usable = is_finite(focus.position) && focus.radius >= 0.0;
    if (!usable || foci_.size() == config_.maximum_foci) continue;
    foci_.push_back(focus);
    least = std::min(least, focus.radius);
  }
  withdrawn_ += withdrawal();
  margin_ = asks_more_ || foci_.empty() ? 0.0 : (config_.leave_factor - 1.0) * least;
  return foci_.size();
}

// The largest distance by which a former ball, with the radius up to which shown entities are kept,
// extends beyond all present balls.
double Interest::withdrawal() const noexcept {
  const auto same = [](const Focus& a, const Focus& b) {
    return a.position == b.position && a.radius == b.radius;
  };
  if (std::ranges::equal(foci_, former_, same)) return 0.0;
  double most = 0.0;
  for (const Focus& former : former_) {
    double least = 2.0 * kFarthest;
    for (const Focus& focus : foci_) {
      const double shrunk = config_.leave_factor * (former.radius - focus.radius);
      least = std::min(least, distance(former.position, focus.position) + shrunk);
    }
    most = std::max(most, least);
  }
  return most;
}

InterestVerdict Interest::verdict(const Position& position, double nimbus, std::uint8_t kind,
                                  bool shown, bool wanted) noexcept {
  if (kind < 32 && (config_.kinds >> kind & 1u) == 0) return InterestVerdict::class_off;
  if (!is_finite(position) || !std::isfinite(nimbus)) return InterestVerdict::not_finite;
  if (wanted) return InterestVerdict::inside;

  bool lingers = false, hidden = false;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Focus& focus : foci_) {
    const double away = distance(position, focus.position) - nimbus;
    const double slack = shown ? config_.leave_factor : 1.0;
    const bool within = away <= focus.radius, stays = away <= config_.leave_factor * focus.radius;
    if (stays && asks_more_ && !is_aware(focus, position, nimbus, slack)) {
      hidden = hidden || within;
      continue;
    }
    if (within) return InterestVerdict::inside;
    nearest = std::min(nearest, away);
    lingers = lingers || stays;
  }
  if (hidden && !(shown && lingers)) return InterestVerdict::hidden;
  if (!shown) {
    nearest_outside_ = std::min(nearest_outside_, nearest);
    return InterestVerdict::outside;
  }
  return lingers ? InterestVerdict::lingering : InterestVerdict::left;
}

// One focus is a ball: distances were compared already, with their slack.
bool Interest::is_aware(const Focus& focus, const Position& position, double nimbus,
                        double slack) const noexcept {
  Observer observer;
  observer.focus.position = focus.position;
  observer.focus.radius = config_.leave_factor * focus.radius;
  observer.aura = slack * config_.aura;
  Subject subject;
  subject.position = position;
  subject.nimbus = nimbus;
  subject.aura = 0.0;
  return AwarenessEvaluator(&occluders_).evaluate(observer, subject) == Awareness::aware;
}

double Interest::gap(const Position& position, double nimbus) const noexcept {
  double nearest = std::numeric_limits<double>::infinity();
  if (!is_finite(position)) return nearest;
  for (const Focus& focus : foci_) {
    double away = distance(position, focus.position) - nimbus - focus.radius;
    if (away <= 0.0 && asks_more_ && !is_aware(focus, position, nimbus, 1.0)) away = kHiddenGap;
    nearest = std::min(nearest, away);
  }
  return nearest;
}

double Interest::spare(const Position& position, double nimbus, std::uint8_t kind,
                       bool wanted) noexcept {
  if (!is_accepted(verdict(position, nimbus, kind, true, wanted))) return 0.0;
  if (wanted) return kLookAgain;
  double most = 0.0;
  for (const Focus& focus : foci_) {
    const double away = distance(position, focus.position) - nimbus;
    most = std::max(most, config_.leave_factor * focus.radius - away);
  }
  return std::min(most, asks_more_ ? kLookAgain : kFarthest);
}

double Interest::distance_to_focus(const Position& position) const noexcept {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Focus& focus : foci_) nearest = std::min(nearest, distance(position, focus.position));
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
                                bool shown, bool wanted) noexcept {
  const InterestVerdict result = verdict(position, nimbus, kind, shown, wanted);
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
    case InterestVerdict::hidden:
      ++counts_.hidden;
      break;
  }
  return result;
}

}  // namespace reckon::aoim

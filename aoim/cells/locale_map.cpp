// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/locale_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace reckon::aoim {
namespace {

bool names(const Locale& locale, std::size_t other) {
  return std::find(locale.neighbours.begin(), locale.neighbours.end(), other) !=
         locale.neighbours.end();
}

void check(const std::vector<Locale>& locales, std::size_t index) {
  const Locale& locale = locales[index];
  const auto refuse = [index](const std::string& what) {
    throw std::invalid_argument("locale " + std::to_string(index) + ": " + what);
  };
  const bool sized = locale.half_x > 0.0 && locale.half_y > 0.0 && locale.half_z > 0.0 &&
                     std::isfinite(locale.half_x) && std::isfinite(locale.half_y);
  if (!sized) refuse("half its length and width must be positive and finite, its height positive");
  if (!is_finite(locale.origin) || !std::isfinite(locale.yaw)) {
    refuse("its origin and yaw must be finite");
  }
  for (const std::uint16_t neighbour : locale.neighbours) {
    if (neighbour >= locales.size() || neighbour == index) {
      refuse("neighbour " + std::to_string(neighbour) + " is not another locale of the list");
    }
    if (!names(locales[neighbour], index)) {
      refuse("neighbour " + std::to_string(neighbour) + " must also have it as a neighbour");
    }
  }
}

}  // namespace

LocaleMap::LocaleMap(std::vector<Locale> locales) : locales_(std::move(locales)) {
  if (locales_.empty() || locales_.size() > kMaximumPool) {
    throw std::invalid_argument(std::to_string(locales_.size()) + " locales: use 1 to 1000");
  }
  for (std::size_t i = 0; i < locales_.size(); ++i) {
    check(locales_, i);
    turns_.push_back({std::cos(locales_[i].yaw), std::sin(locales_[i].yaw)});
  }
}

double LocaleMap::finest() const noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const Locale& locale : locales_) least = std::min({least, locale.half_x, locale.half_y});
  return 2.0 * least;
}

// Tests balls all over each locale, each enlarged to contain the balls of the centres around it.
std::size_t LocaleMap::groups_bound(double radius) const {
  constexpr int kSteps = 8;
  std::size_t most = 0;
  for (std::size_t home = 0; home < locales_.size(); ++home) {
    const double x = locales_[home].half_x / kSteps, y = locales_[home].half_y / kSteps;
    const bool is_box = std::isfinite(locales_[home].half_z);
    const double reach = radius + std::hypot(x, y, is_box ? locales_[home].half_z : 0.0);
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const Position local{(2 * (i % kSteps) + 1 - kSteps) * x, (2 * (i / kSteps) + 1 - kSteps) * y,
                           0.0};
      const Position middle = to_scene({static_cast<std::int32_t>(home), 0}, local);
      std::size_t count = 0;
      for_each_reached(home, middle, reach, [&](CellId, double) { ++count; });
      most = std::max(most, count);
    }
  }
  return most;
}

Position LocaleMap::to_locale(CellId cell, const Position& position) const noexcept {
  const Locale& locale = locales_[place(cell)];
  const auto [c, s] = turns_[place(cell)];
  const double x = position.x - locale.origin.x, y = position.y - locale.origin.y;
  return {c * x + s * y, c * y - s * x, position.z - locale.origin.z};
}

Position LocaleMap::to_scene(CellId cell, const Position& local) const noexcept {
  const Locale& locale = locales_[place(cell)];
  const auto [c, s] = turns_[place(cell)];
  return {locale.origin.x + c * local.x - s * local.y, locale.origin.y + s * local.x + c * local.y,
          locale.origin.z + local.z};
}

double LocaleMap::distance(CellId cell, const Position& position) const noexcept {
  const Locale& locale = locales_[place(cell)];
  const Position local = to_locale(cell, position);
  const double x = std::max(std::abs(local.x) - locale.half_x, 0.0);
  const double y = std::max(std::abs(local.y) - locale.half_y, 0.0);
  const double z = std::max(std::abs(local.z) - locale.half_z, 0.0);
  return std::sqrt(x * x + y * y + z * z);
}

CellId LocaleMap::cell(const Position& position) const noexcept {
  double nearest = std::numeric_limits<double>::infinity();
  CellId found{0, 0};
  for (std::size_t i = 0; i < locales_.size() && nearest > 0.0; ++i) {
    const CellId here{static_cast<std::int32_t>(i), 0};
    const double away = distance(here, position);
    if (away >= nearest || std::isnan(away)) continue;
    nearest = away;
    found = here;
  }
  return found;
}

}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/sight.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

// A shown entity stays shown within this share of a cell beyond the followed cell. When the beacon
// crosses a border, it is received in the next cell before the map has it there.
constexpr double kLingers = 0.5;
// An entity on a border is in one cell for its owner, and may be predicted in the other: by the
// rounding of the wire format, and within its owner's threshold.
constexpr double kBorder = 0.05;

}  // namespace

Sight::Sight(const InterestConfig& config, const CellPartition& cells,
             const Subscription& subscription, std::span<const std::uint32_t> follow, double finest)
    : cells_(cells), subscription_(subscription), interest_(config), finest_(finest) {
  for (const std::uint32_t tag : follow) followed_.push_back({tag, false, {}, {}, {}, {}});
  besides_.reserve(followed_.size());
}

bool Sight::is_in_followed_cell(const Position& position, bool shown) const noexcept {
  if (!is_finite(position)) return false;
  return is_in_or_near(position, shown ? kLingers : kBorder, [this](GroupIndex number) {
    return std::find(besides_.begin(), besides_.end(), number) != besides_.end();
  });
}

// A position beyond the wall of a locale is another locale, at any distance.
bool Sight::is_unheard(const Position& position) const noexcept {
  if (!is_finite(position)) return false;
  if (cells_.as<LocaleMap>() != nullptr) return !subscription_.is_joined(cells_.group(position));
  return !is_in_or_near(position, kBorder,
                        [this](GroupIndex number) { return subscription_.is_joined(number); });
}

bool Sight::is_in_or_near(const Position& position, double share, auto&& is_one) const noexcept {
  if (is_one(cells_.group(position))) return true;
  const double beyond = share * finest_;
  bool found = false;
  cells_.visit([&](const auto& scheme) {
    scheme.for_each_cell_within(position, beyond, [&](CellId cell, double) {
      found = found || is_one(scheme.group(cell));
    });
  });
  return found;
}

}  // namespace reckon::aoim

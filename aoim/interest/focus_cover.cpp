// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/interest/focus_cover.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace reckon::aoim {
namespace {

constexpr double kFarthest = 0x1p62;  // squares from the origin; farther ones count as there
// The same if locales are distinguished by columns.
constexpr std::int64_t kFarthestColumn = std::int64_t{1} << 50, kLocales = 1024;
static_assert(kMaximumPool < kLocales);
constexpr int kLastLevel = 63;  // one square a quadrant, at any distance
// The sum of a distance and a radius is rounded; this factor covers the error (a few units of
// 2^-53).
constexpr double kRounded = 1.0 + 0x1p-50;

bool is_usable(const Focus& entity) noexcept {
  return is_finite(entity.position) && entity.radius >= 0.0;
}

// Each locale has its own columns. Not inline: few scenes have locales, and the loop is to stay
// short.
[[gnu::noinline]] std::int64_t column_in_locale(const LocaleMap& locales, const Position& position,
                                                std::int64_t column) noexcept {
  return std::clamp(column, -kFarthestColumn, kFarthestColumn) * kLocales +
         locales.group(position).value;
}

Position middle(const Position& a, const Position& b) noexcept {
  return {0.5 * a.x + 0.5 * b.x, 0.5 * a.y + 0.5 * b.y, 0.5 * a.z + 0.5 * b.z};
}

}  // namespace

FocusCover::FocusCover(double least_side, const LocaleMap* locales)
    : least_side_(least_side),
      slots_(std::bit_ceil(4 * most(locales))),
      groups_(most(locales)),
      foci_(most(locales)) {
  if (locales != nullptr) locales_ = *locales;
}

std::span<const Focus> FocusCover::cover(std::span<const Focus> entities) noexcept {
  double least_radius = std::numeric_limits<double>::max();
  for (const Focus& entity : entities) {
    if (is_usable(entity)) least_radius = std::min(least_radius, entity.radius);
  }
  side_ = std::max(least_side_, 0.5 * least_radius);

  const int level = settle(entities);
  // In a locale, moves the focus to the place of one of the entities.
  for (std::size_t i = 0; i < count_; ++i) {
    Group& group = groups_[i];
    group.centre = locales_ ? group.only.position : middle(group.least, group.most);
  }
  enlarge(entities, level);
  for (std::size_t i = 0; i < count_; ++i) {
    const Group& group = groups_[i];
    foci_[i] = group.only;
    if (group.count > 1) foci_[i] = {group.centre, group.speed, group.radius, group.cut};
  }
  return {foci_.data(), count_};
}

// Gathers at the finest level that has room for all, and returns it. The squares of a level are
// within the squares of the next, so the number of occupied ones falls. With locales the last level
// has one square for each, which may be more than the limit.
int FocusCover::settle(std::span<const Focus> entities) noexcept {
  room_ = kMostFoci;
  if (gather(entities, 0)) return 0;
  int too_fine = 0, level = kLastLevel;
  while (level - too_fine > 1) {
    const int half = (level + too_fine) / 2;
    (gather(entities, half) ? level : too_fine) = half;
  }
  if (gather(entities, level)) return level;
  room_ = groups_.size();
  gather(entities, level);
  return level;
}

FocusCover::Square FocusCover::square_of(const Position& position, int level) const noexcept {
  const auto index = [&](double along) {
    const double squares = std::clamp(along / side_, -kFarthest, kFarthest);
    return static_cast<std::int64_t>(std::floor(squares)) >> level;
  };
  const bool whole = locales_ && level == kLastLevel;  // one for each locale
  const Square square = whole ? Square{0, 0} : Square{index(position.x), index(position.y)};
  if (locales_) [[unlikely]]
    return {column_in_locale(*locales_, position, square.column), square.row};
  return square;
}

// Index of a square's group; room_ if all groups are in use.
std::size_t FocusCover::find_or_open(const Square& square) noexcept {
  const std::uint64_t bits = static_cast<std::uint64_t>(square.column) * 0x9E3779B97F4A7C15ULL +
                             static_cast<std::uint64_t>(square.row) * 0xC2B2AE3D27D4EB4FULL;
  const std::size_t mask = slots_.size() - 1;
  auto slot = static_cast<std::size_t>(bits >> 32) & mask;
  while (slots_[slot] != 0 && groups_[slots_[slot] - 1u].square != square) {
    slot = (slot + 1) & mask;
  }
  if (slots_[slot] != 0) return slots_[slot] - 1u;
  if (count_ == room_) return room_;
  groups_[count_] = {};
  groups_[count_].square = square;
  slots_[slot] = static_cast<std::uint16_t>(++count_);
  return count_ - 1;
}

// Puts entities into the squares of a level; false, before all are placed, if there are too many
// squares.
bool FocusCover::gather(std::span<const Focus> entities, int level) noexcept {
  std::ranges::fill(slots_, std::uint16_t{0});
  count_ = 0;
  for (const Focus& entity : entities) {
    if (!is_usable(entity)) continue;
    const std::size_t index = find_or_open(square_of(entity.position, level));
    if (index == room_) return false;
    Group& group = groups_[index];
    const Position& p = entity.position;
    if (group.count++ == 0) {
      group.only = entity;
      group.least = group.most = p;
    }
    group.least = {std::min(group.least.x, p.x), std::min(group.least.y, p.y),
                   std::min(group.least.z, p.z)};
    group.most = {std::max(group.most.x, p.x), std::max(group.most.y, p.y),
                  std::max(group.most.z, p.z)};
    if (entity.speed > group.speed) group.speed = entity.speed;
  }
  return true;
}

// Sets the radii, after the centres are fixed, so that each contains its entities' balls.
void FocusCover::enlarge(std::span<const Focus> entities, int level) noexcept {
  for (const Focus& entity : entities) {
    if (!is_usable(entity)) continue;
    Group& group = groups_[find_or_open(square_of(entity.position, level))];
    const double away = distance(group.centre, entity.position);
    const auto needed = [away](double own) { return away > 0.0 ? (away + own) * kRounded : own; };
    group.radius = std::max(group.radius, needed(entity.radius));
    group.cut = std::max(group.cut, needed(entity.cut));
  }
}

}  // namespace reckon::aoim

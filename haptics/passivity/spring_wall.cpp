// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/spring_wall.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

double sign_of(WallSide side) noexcept { return side == WallSide::below ? 1.0 : -1.0; }

// Position at which its force reaches its greatest value [m].
double end_of(const SpringWall& wall, WallSide side) noexcept {
  return wall.stiffness > 0 ? wall.at - sign_of(side) * wall.most / wall.stiffness : wall.at;
}

}  // namespace

double depth_in(const SpringWall& wall, WallSide side, double x) noexcept {
  return wall.stiffness > 0 ? std::max(0.0, sign_of(side) * (wall.at - x)) : 0.0;
}

double force_of(const SpringWall& wall, WallSide side, double x) noexcept {
  return sign_of(side) * std::min(wall.most, wall.stiffness * depth_in(wall, side, x));
}

double stored_in(const SpringWall& wall, WallSide side, double x) noexcept {
  const double depth = depth_in(wall, side, x);
  if (!(depth > 0)) return 0.0;
  const double grows = std::min(depth, wall.most / wall.stiffness);
  return 0.5 * wall.stiffness * grows * grows + wall.most * (depth - grows);
}

// Between the starts of the four pieces, the difference is a parabola, whose slope is the
// difference of the forces.
double worst_rise(const SpringWall& old, const SpringWall& next, WallSide side,
                  PlaceRange places) noexcept {
  const auto rise = [&](double x) { return stored_in(next, side, x) - stored_in(old, side, x); };
  const auto slope = [&](double x) { return force_of(old, side, x) - force_of(next, side, x); };
  std::array<double, 6> cuts{places.from, old.at,  end_of(old, side),
                             places.to,   next.at, end_of(next, side)};
  for (double& cut : cuts) cut = std::clamp(cut, places.from, places.to);
  std::ranges::sort(cuts);
  double worst = rise(cuts.front());
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double a = cuts[i - 1], b = cuts[i];
    worst = std::max(worst, rise(b));
    const double at_a = slope(a), at_b = slope(b);
    if (at_a > 0 && at_b < 0) worst = std::max(worst, rise(a + (b - a) * at_a / (at_a - at_b)));
  }
  return worst;
}

}  // namespace reckon::haptics

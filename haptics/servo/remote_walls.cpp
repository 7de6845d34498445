// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/remote_walls.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

// Stiffness of the spring to the nearest point [N/m]: the initial slope outside, or force / depth
// inside.
double stiffness_of(const ContactParameters& theta, double depth) noexcept {
  return depth > 0 ? normal_load(theta, depth).force / depth : theta.gain * slope_at(theta, 0.0);
}

}  // namespace

void RemoteWalls::advance(const ContactSet* news, const StepContext& step,
                          std::uint64_t count) noexcept {
  for (RemoteContact* remote : hands_.all()) remote->settle(step);
  if (news != nullptr) hands_.take(*news, step, count);
  hands_.advance(step, count, gifts_);
  for (RemoteContact* remote : hands_.all()) remote->ask_nothing();
}

void RemoteWalls::add(const ServoConfig& config, const Eigen::Vector3d& place, std::size_t axes,
                      double most_force, SpringModel& model) const noexcept {
  for (const RemoteContact* remote : hands_.all()) {
    const ContactParameters& theta = remote->spring().parameters();
    const ContactGeometry& at = remote->spring().geometry();
    if (!is_usable(theta) || !(at.depth > -kAhead)) continue;
    const Eigen::Vector3d normal = config.device_orientation.conjugate() * at.normal;
    const double stiffness = stiffness_of(theta, at.depth);
    if (!(stiffness > 0) || !std::isfinite(stiffness)) continue;
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      if (!(std::abs(normal[i]) >= kFlat)) continue;
      const bool is_below = normal[i] > 0;
      const double begins = place[i] + at.depth * normal[i];
      SpringWall& wall = model.wall(axis, is_below ? WallSide::below : WallSide::above);
      if (wall.stiffness > 0 && (is_below ? wall.at >= begins : wall.at <= begins)) continue;
      wall = {begins, stiffness, most_force};
    }
  }
}

void RemoteWalls::publish(const StepContext& step, double share, AccountList& out) noexcept {
  out.count = 0;
  for (RemoteContact* remote : hands_.all()) {
    remote->shown(share, 0.0);
    out.contacts[out.count++] = remote->account(step, 0.0);
  }
}

bool RemoteWalls::touching() const noexcept {
  return std::ranges::any_of(hands_.all(), &RemoteContact::touching);
}

}  // namespace reckon::haptics

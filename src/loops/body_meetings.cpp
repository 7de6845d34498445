// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/body_meetings.hpp"

#include <algorithm>

#include "reckon/peer/loops/hand_approach.hpp"

namespace reckon::peer {
namespace {

constexpr double kMoves = 0.01;  // [m/s]

}  // namespace

void BodyMeetings::look(std::span<const haptics::BodyState> bodies,
                        std::chrono::nanoseconds now) noexcept {
  if (now - looked_ < kLook) return;
  looked_ = now;
  met_.fill({});
  const std::size_t count = std::min(bodies.size(), met_.size());
  for (std::uint32_t own = 0; own < count; ++own) {
    if (!bodies[own].is_owned() || !bodies[own].awake) continue;
    const double size = 0.5 * world_->box(own).sizes().norm();
    for (std::size_t other = 0; other < count; ++other) {
      if (bodies[other].is_owned()) continue;
      const Eigen::Vector3d velocity = bodies[own].velocity - bodies[other].velocity;
      const double reach =
          size + 0.5 * world_->box(other).sizes().norm() + HandApproach::kSoon * velocity.norm();
      const bool is_far =
          (bodies[own].position - bodies[other].position).squaredNorm() > reach * reach;
      if (is_far || velocity.norm() < kMoves) continue;
      const ApproachingHand body{bodies[own].position, bodies[own].velocity, size};
      const double time = time_to_contact(body, bodies[other], world_->box(other));
      if (time < met_[other].time) met_[other] = {time, own};
    }
  }
}

}  // namespace reckon::peer

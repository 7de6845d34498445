// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/body_meetings.hpp"

#include <algorithm>

#include "reckon/peer/loops/hand_approach.hpp"

namespace reckon::peer {
namespace {

constexpr double kMoves = 0.01;  // [m/s]
constexpr double kBeside = 0.1;  // [s]; bodies that felt copies meet within it are copied too

}  // namespace

void BodyMeetings::look(std::span<const haptics::BodyState> bodies,
                        std::chrono::nanoseconds now) noexcept {
  if (now - looked_ < kLook) return;
  looked_ = now;
  met_.fill({});
  beside_.reset();
  const std::size_t count = std::min(bodies.size(), met_.size());
  for (std::uint32_t own = 0; own < count; ++own) {
    const bool is_felt = bodies[own].copied && bodies[own].touched;
    if (!(bodies[own].is_owned() || is_felt) || !bodies[own].awake) continue;
    const double size = 0.5 * world_->box(own).sizes().norm();
    for (std::size_t other = 0; other < count; ++other) {
      if (bodies[other].is_owned()) continue;
      const Eigen::Vector3d velocity = bodies[own].velocity - bodies[other].velocity;
      const double reach =
          size + 0.5 * world_->box(other).sizes().norm() + HandApproach::kSoon * velocity.norm();
      const bool is_far =
          (bodies[own].position - bodies[other].position).squaredNorm() > reach * reach;
      if (other == own || is_far || (!is_felt && velocity.norm() < kMoves)) continue;
      const ApproachingHand body{bodies[own].position, bodies[own].velocity, size};
      const double time = time_to_contact(body, bodies[other], world_->box(other));
      if (is_felt) {
        if (time < kBeside) beside_.set(other);
      } else if (time < met_[other].time) {
        met_[other] = {time, own};
      }
    }
  }
}

}  // namespace reckon::peer

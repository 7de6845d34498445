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
  note_company(bodies);
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

void BodyMeetings::note_company(std::span<const haptics::BodyState> bodies) noexcept {
  std::array<ObjectSet, kMostSharedBodies> islands{};
  const std::size_t count = std::min(bodies.size(), companies_.size());
  for (std::size_t i = 0; i < count; ++i)
    if (bodies[i].is_owned() && bodies[i].island < count) islands[bodies[i].island].set(i);
  for (std::size_t i = 0; i < count; ++i) {
    if (bodies[i].island >= count) continue;
    const ObjectSet& island = islands[bodies[i].island];
    if (island.count() > 1 && island[i]) companies_[i] = {island, looked_};
  }
}

ObjectSet BodyMeetings::company_of(std::size_t body,
                                   std::span<const haptics::BodyState> bodies) const noexcept {
  ObjectSet company;
  if (body >= companies_.size() || looked_ - companies_[body].seen >= kContactHold) return company;
  for (std::size_t i = 0; i < std::min(bodies.size(), company.size()); ++i)
    company[i] = companies_[body].bodies[i] && bodies[i].is_owned();
  return company;
}

}  // namespace reckon::peer

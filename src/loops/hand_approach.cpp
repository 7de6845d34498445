// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/hand_approach.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::peer {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double time_to_contact(const ApproachingHand& hand, const haptics::ObjectMotion& body,
                       const Eigen::AlignedBox3d& box) noexcept {
  const Eigen::Matrix3d to_body = body.orientation.conjugate().toRotationMatrix();
  const Vector3d way = to_body * (hand.velocity - body.velocity_at(hand.position));
  const Vector3d from = to_body * (hand.position - body.position);
  const double margin = hand.radius + HandApproach::kAside * hand.velocity.norm();
  double enters = 0.0, leaves = kInfinity;
  for (int i = 0; i < 3; ++i) {
    const double low = box.min()[i] - margin - from[i], high = box.max()[i] + margin - from[i];
    if (way[i] == 0.0) {
      if (low > 0.0 || high < 0.0) return kInfinity;
      continue;
    }
    enters = std::max(enters, std::min(low / way[i], high / way[i]));
    leaves = std::min(leaves, std::max(low / way[i], high / way[i]));
  }
  return enters <= leaves ? enters : kInfinity;
}

void HandApproach::look(std::span<const haptics::BodyState> bodies) noexcept {
  std::array<ApproachingHand, kMaxDevices> room;
  const std::span<const ApproachingHand> hands(room.data(), touch_.copy_hands(room));
  if (hands.empty()) return;
  times_.fill(kInfinity);
  for (std::size_t i = 0; i < std::min(bodies.size(), times_.size()); ++i) {
    const Eigen::AlignedBox3d& box = world_->box(i);
    const double size = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
    for (const ApproachingHand& hand : hands) {
      const double speed = (hand.velocity - bodies[i].velocity).norm();
      const double reach = size + hand.radius + (kSoon + kAside) * speed;
      if ((hand.position - bodies[i].position).squaredNorm() > reach * reach) continue;
      const double time = time_to_contact(hand, bodies[i], box);
      if (time <= kSoon) times_[i] = std::min(times_[i], time);
    }
  }
}

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/diff/motion_difference.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr double kDegrees = 180 / std::numbers::pi;

void copy_timestamp(const std::vector<std::byte>& from, std::vector<std::byte>& to) {
  constexpr std::size_t kAt = 4;
  constexpr std::size_t kSize = 4;
  if (from.size() < kAt + kSize || to.size() < kAt + kSize) return;
  std::copy_n(from.begin() + kAt, kSize, to.begin() + kAt);
}

}  // namespace

void ReckonedCapture::take_pdu(const HeldPdu& pdu) {
  if (!pdu.decoded) return;
  // As relative time, so that a replayed or shifted capture gives the result of the original.
  std::vector<std::byte> relative = pdu.octets;
  relative[7] &= std::byte{0xFE};
  poses_.take_pdu(relative, pdu.header, pdu.time);
  haptic_.take_pdu(relative, pdu.header, pdu.time);
  if (pdu.ends_datagram) haptic_.end_datagram();
}

std::span<const ContactForce> ReckonedCapture::forces_at(nanoseconds time) {
  haptic_.forget_silent(time);
  return forces_.forces_at(haptic_, time);
}

void MotionDifference::Side::feed(nanoseconds until) {
  while (has_next && due() <= until) {
    next.time -= shift;
    capture.take_pdu(next);
    has_next = stream->next(next);
  }
  capture.forget_silent(until);
}

void MotionDifference::begin(PduStream& a, PduStream& b) {
  a_.stream = &a;
  b_.stream = &b;
  b_.shift = shift_;
  a_.has_next = a.next(a_.next);
  b_.has_next = b.next(b_.next);
  if (!a_.has_next || !b_.has_next) a_.has_next = b_.has_next = false;
  start_ = now_ = std::max(a_.due(), b_.due());
}

bool MotionDifference::advance() {
  if (!a_.has_next && !b_.has_next) return false;
  a_.feed(now_);
  b_.feed(now_);
  compare_poses();
  compare_forces();
  nanoseconds arrival = nanoseconds::max();
  for (const Side* side : {&a_, &b_})
    if (side->has_next) arrival = std::min(arrival, side->due());
  step_on(arrival);
  return true;
}

void MotionDifference::step_on(nanoseconds arrival) {
  now_ += step_;
  if (!a_.capture.poses().entities().empty() && !b_.capture.poses().entities().empty()) return;
  if (arrival != nanoseconds::max() && arrival > now_)
    now_ += (arrival - now_ + step_ - nanoseconds(1)) / step_ * step_;
}

void MotionDifference::take_step(AlignedPdus& step) {
  const bool in_a = step.kind != AlignedPdus::Kind::only_b;
  const bool in_b = step.kind != AlignedPdus::Kind::only_a;
  const nanoseconds time = in_a ? step.a.time : pairs_.in_a(step.b.time);
  if (in_a && in_b) {
    pairs_.a = step.a.time;
    pairs_.b = step.b.time;
    copy_timestamp(step.a.octets, step.b.octets);
  }
  if (!has_begun_) start_ = now_ = time;
  has_begun_ = true;
  while (now_ < time) {
    compare_now();
    step_on(time);
  }
  step.a.time = step.b.time = time;
  if (in_a) a_.capture.take_pdu(step.a);
  if (in_b) b_.capture.take_pdu(step.b);
}

void MotionDifference::compare_to_end() {
  if (has_begun_) compare_now();
}

void MotionDifference::compare_now() {
  a_.capture.forget_silent(now_);
  b_.capture.forget_silent(now_);
  compare_poses();
  compare_forces();
}

void MotionDifference::compare_poses() {
  for (const ReceivedEntity& entity : a_.capture.poses().entities()) {
    const ReceivedEntity* other = b_.capture.poses().find_entity(entity.id);
    if (other == nullptr) continue;
    const EntityKey key{entity.id.site, entity.id.application, entity.id.entity};
    if (!poses_.contains(key) && poses_.size() == kMostRows) continue;
    const deadreckon::Pose a = entity.pose_at(now_);
    const deadreckon::Pose b = other->pose_at(now_);
    PoseDifference& difference = poses_[key];
    difference.metres.add((b.position - a.position).norm(), now_ - start_);
    difference.degrees.add(kDegrees * a.orientation.angularDistance(b.orientation), now_ - start_);
  }
}

void MotionDifference::compare_forces() {
  std::map<PairKey, std::array<Eigen::Vector3d, 2>> now;
  const auto collect = [&](Side& side, std::size_t index) {
    for (const ContactForce& found : side.capture.forces_at(now_)) {
      const PairKey key{found.on.site, found.on.application, found.on.entity,
                        found.by.site, found.by.application, found.by.entity};
      const auto place = now.try_emplace(
          key, std::array<Eigen::Vector3d, 2>{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
      place.first->second[index] = found.force;
    }
  };
  collect(a_, 0);
  collect(b_, 1);
  for (const auto& [key, forces] : now) {
    if (!forces_.contains(key) && forces_.size() == kMostRows) continue;
    forces_[key].add((forces[1] - forces[0]).norm(), now_ - start_);
  }
}

}  // namespace reckon::tools

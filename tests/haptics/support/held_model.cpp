// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/haptics/support/held_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cerrno>
#include <utility>

#include "reckon/pdu/seconds.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr nanoseconds kStep = std::chrono::microseconds(50);
constexpr nanoseconds kLedStep = std::chrono::milliseconds(1);
constexpr nanoseconds kFrame = std::chrono::milliseconds(1);

}  // namespace

HeldModel::HeldModel(const HeldModelOptions& options, std::function<Vector3d(double)> hand)
    : options_(options), hand_(std::move(hand)), position_(hand_(0)) {}

void HeldModel::begin() {
  move(0);
  first_height_ = height(angles_);
}

double HeldModel::lifted() const { return height(angles_) - first_height_; }

Vector3d HeldModel::force() const { return jacobian_.transpose().inverse() * torques(); }

// Of the links, by the slope of their height over the joints.
Vector3d HeldModel::weight() const {
  constexpr double kStep = 1e-5;
  Vector3d slope;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = kStep * Vector3d::Unit(i);
    slope[i] = (height(angles_ + step) - height(angles_ - step)) / (2 * kStep);
  }
  if (slope.isZero(0)) return slope;
  return jacobian_.transpose().inverse() * -slope;
}

// By the friction of its joints, at the end of a step: near a singular pose it is stiff.
Vector3d HeldModel::slowed(const Vector3d& velocity, double h) const {
  if (!(options_.joint_damping > 0)) return velocity;
  const Eigen::Matrix3d turning = jacobian_.inverse();
  const Eigen::Matrix3d friction = options_.joint_damping * turning.transpose() * turning;
  return (Eigen::Matrix3d::Identity() + h / options_.mass * friction).inverse() * velocity;
}

void HeldModel::pass(nanoseconds time) {
  const nanoseconds end = now_ + time;
  while (now_ < end) {
    const nanoseconds h = std::min(led_ ? kLedStep : kStep, end - now_);
    moved_ += h;
    if (!led_ && moved_ >= options_.motion_step)
      move(pdu::to_seconds(std::exchange(moved_, nanoseconds(0))));
    now_ += h;
    run_line();
    if (beside_) beside_(now_);
  }
}

void HeldModel::lead(const Vector3d& place) {
  led_ = true;
  moved_ = nanoseconds(0);
  velocity_.setZero();
  if (place == position_) return;
  position_ = place;
  if (const std::optional<Joints> joints = joints_at(place)) {
    angles_ = joints->angles;
    if (!joints->jacobian.isZero(0)) jacobian_ = joints->jacobian;
  }
}

// Velocity first, as in SimulatedDevice: each ledger uses the velocity that moves the handle.
void HeldModel::move(double h) {
  const Vector3d before = angles_;
  if (h > 0) {
    const double t = pdu::to_seconds(now_);
    const Vector3d wanted = hand_(t);
    const Vector3d speed = (hand_(t + 1e-4) - wanted) / 1e-4;
    const Vector3d hand = options_.hand_stiffness * (wanted - position_) +
                          options_.hand_damping * (speed - velocity_);
    const Vector3d hangs = carried_ < 1 ? Vector3d((1 - carried_) * weight()) : Vector3d::Zero();
    velocity_ += h / options_.mass * (hand + force() + hangs - options_.damping * velocity_);
    velocity_ = slowed(velocity_, h);
    position_ += h * velocity_;
    damping_loss_ += h * options_.damping * velocity_.squaredNorm();
  }
  const std::optional<Joints> joints = joints_at(position_);
  if (!joints) {  // at the end of its reach
    position_ -= h * velocity_;
    velocity_.setZero();
    return;
  }
  angles_ = joints->angles;
  if (!joints->jacobian.isZero(0)) jacobian_ = joints->jacobian;
  if (!(h > 0)) return;
  const Vector3d turn = angles_ - before;
  port_work_ -= torques().dot(turn);
  damping_loss_ += options_.joint_damping * turn.squaredNorm() / h;
  rounding_ += half_steps().dot(turn.cwiseAbs());
}

void HeldModel::begin_out(std::span<const std::uint8_t> octets) {
  out_.assign(octets.begin(), octets.end());
  const auto at = nanoseconds(static_cast<std::int64_t>(1e6 * options_.out_at));
  out_at_ = ((now_ - at) / kFrame + 1) * kFrame + at;
}

std::optional<int> HeldModel::out_done() {
  if (std::exchange(stalls_, false)) return -EPIPE;
  if (now_ < out_at_ || now_ < hangs_until_ || !has_room()) return std::nullopt;
  std::span<const std::uint8_t> taken(out_);
  if (std::exchange(cuts_, false)) taken = taken.first(taken.size() / 2);
  take_transfer(taken);
  return static_cast<int>(taken.size());
}

}  // namespace reckon::test

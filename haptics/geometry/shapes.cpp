// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// How far from its goal friction leaves an SCP that lies `lateral` from it, under `load`.
double stay(FrictionCone* friction, double lateral, double load) {
  if (friction == nullptr) return 0.0;
  const double held = friction->held(lateral, load, friction->sliding());
  friction->set_sliding(held < lateral);
  return held;
}

SettledPoint free_at(const Vector3d& device, FrictionCone* friction) {
  if (friction != nullptr) friction->set_sliding(false);
  return {device, Vector3d::Zero(), false};
}

}  // namespace

HalfSpace::HalfSpace(const PlaneShape& shape) : normal_(shape.normal.normalized()) {
  if (!shape.normal.allFinite() || !(shape.normal.norm() > 0.0)) {
    throw std::invalid_argument("plane: normal must be finite and not zero; give e.g. [0, 0, 1]");
  }
}

bool HalfSpace::contains(const Vector3d& p) const noexcept { return normal_.dot(p) < 0.0; }

Vector3d HalfSpace::nearest_outside(const Vector3d& p) const noexcept {
  return p - normal_.dot(p) * normal_;
}

SettledPoint HalfSpace::settle(const Vector3d& scp, const Vector3d& device,
                               FrictionCone* friction) const noexcept {
  const double depth = -normal_.dot(device);
  if (!(depth > 0.0)) return free_at(device, friction);
  // Coming from free space it lands where the straight way meets the plane.
  const double height = std::max(normal_.dot(scp), 0.0);
  const Vector3d landed = nearest_outside(scp + height / (height + depth) * (device - scp));
  const Vector3d goal = nearest_outside(device);
  const double lateral = (landed - goal).norm();
  const double held = stay(friction, lateral, depth);
  if (held >= lateral) return {landed, normal_, true};
  return {goal + held / lateral * (landed - goal), normal_, true};
}

Eigen::AlignedBox3d HalfSpace::bounds() const noexcept {
  const Vector3d all = Vector3d::Constant(std::numeric_limits<double>::max());
  return {-all, all};
}

Ball::Ball(const SphereShape& shape) : radius_(shape.radius) {
  if (!(radius_ > 0.0) || !std::isfinite(radius_)) {
    throw std::invalid_argument("sphere: radius must be finite and above 0 m");
  }
}

bool Ball::contains(const Vector3d& p) const noexcept { return p.norm() < radius_; }

Vector3d Ball::nearest_outside(const Vector3d& p) const noexcept {
  const double distance = p.norm();
  return distance > 0.0 ? Vector3d(p * (radius_ / distance)) : Vector3d(0.0, 0.0, radius_);
}

// First point of the way that lies on the ball.
bool Ball::lands(const Vector3d& from, const Vector3d& to, Vector3d& at) const noexcept {
  const Vector3d way = to - from;
  const double way_squared = way.squaredNorm();
  const double inward = -from.dot(way);
  if (!(inward > 0.0) || !(way_squared > 0.0)) return false;
  const double nearest_t = inward / way_squared;
  const double half_chord = radius_ * radius_ - (from + nearest_t * way).squaredNorm();
  if (half_chord <= 0.0) return false;
  const double t = nearest_t - std::sqrt(half_chord / way_squared);
  if (t > 1.0) return false;
  at = nearest_outside(from + std::max(t, 0.0) * way);
  return true;
}

SettledPoint Ball::settle(const Vector3d& scp, const Vector3d& device,
                          FrictionCone* friction) const noexcept {
  Vector3d landed;
  if (!lands(scp, device, landed)) return free_at(device, friction);
  const double distance = device.norm();
  const bool outside = distance >= radius_;
  if (friction == nullptr) {
    if (outside) return free_at(device, friction);
    if (!(distance > 1e-12 * radius_)) return {landed, landed / radius_, true};
    return {nearest_outside(device), device / distance, true};
  }

  // In the plane of landed and device, at the angle between them: tangential d sin a, normal
  // R - d cos a. Sliding stops where the first is the kinetic share of the second.
  const Vector3d up = landed / radius_;
  const double height = device.dot(up);
  const Vector3d across = device - height * up;
  const double lateral = across.norm();
  const double load = radius_ - height;
  const bool slides = lateral > friction->coefficient(friction->sliding()) * load;
  friction->set_sliding(slides);
  if (!slides) return {landed, up, true};
  const double mu = friction->kinetic();
  const double sine = mu * radius_ / (distance * std::sqrt(1.0 + mu * mu));
  const double rest = sine < 1.0 ? std::asin(sine) - std::atan(mu) : 0.0;
  if (rest <= 0.0 && outside) return free_at(device, friction);
  const Vector3d towards = nearest_outside(device) / radius_;
  const Vector3d side = (up - up.dot(towards) * towards).normalized();
  const double angle = std::max(rest, 0.0);
  const Vector3d normal = std::cos(angle) * towards + std::sin(angle) * side;
  return {radius_ * normal, normal, true};
}

Eigen::AlignedBox3d Ball::bounds() const noexcept {
  return {Vector3d::Constant(-radius_), Vector3d::Constant(radius_)};
}

Block::Block(const BoxShape& shape) : half_(0.5 * shape.size) {
  if (!shape.size.allFinite() || !(shape.size.minCoeff() > 0.0)) {
    throw std::invalid_argument("box: each of the three sizes must be finite and above 0 m");
  }
  clearance_ = kRelativeClearance * shape.size.norm();
}

bool Block::contains(const Vector3d& p) const noexcept {
  return (p.cwiseAbs().array() < half_.array()).all();
}

Vector3d Block::nearest_outside(const Vector3d& p) const noexcept {
  Eigen::Index axis = 0;
  (half_ - p.cwiseAbs()).minCoeff(&axis);
  Vector3d out = p;
  out[axis] = std::copysign(half_[axis] + clearance_, p[axis]);
  return out;
}

// Axis of the face through which the way enters the box grown by 0.99 clearances; -1 for none.
int Block::entry_axis(const Vector3d& from, const Vector3d& step) const noexcept {
  double enter = 0.0;
  double leave = 1.0;
  int axis = -1;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double reach = half_[i] + 0.99 * clearance_;
    if (step[i] == 0.0) {
      if (std::abs(from[i]) >= reach) return -1;
      continue;
    }
    const double t0 = (-std::copysign(reach, step[i]) - from[i]) / step[i];
    const double t1 = (std::copysign(reach, step[i]) - from[i]) / step[i];
    if (t0 >= enter) {
      enter = t0;
      axis = static_cast<int>(i);
    }
    leave = std::min(leave, t1);
  }
  return enter < leave ? axis : -1;
}

SettledPoint Block::settle(const Vector3d& scp, const Vector3d& device,
                           FrictionCone* friction) const noexcept {
  const Vector3d step = device - scp;
  const int axis = entry_axis(scp, step);
  if (axis < 0) return free_at(device, friction);

  // Land one clearance above the face, slide on that plane; past the face's border all is free,
  // for there the device is beyond the border too.
  const double sign = scp[axis] < 0.0 ? -1.0 : 1.0;
  const double level = half_[axis] + clearance_;
  const double back = std::max(0.0, (scp[axis] * sign - level) / (-step[axis] * sign));
  const Vector3d landed = scp + back * step;
  Vector3d goal = device;
  goal[axis] = landed[axis];
  const double lateral = (landed - goal).norm();
  const double held = stay(friction, lateral, std::abs(goal[axis] - device[axis]));
  const Vector3d at = held >= lateral ? landed : Vector3d(goal + held / lateral * (landed - goal));
  for (int i = 0; i < 3; ++i) {
    if (i != axis && std::abs(at[i]) >= half_[i] + 0.99 * clearance_)
      return free_at(device, friction);
  }
  return {at, sign * Vector3d::Unit(axis), true};
}

Eigen::AlignedBox3d Block::bounds() const noexcept { return {-half_, half_}; }

}  // namespace reckon::haptics

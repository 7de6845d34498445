// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "reckon/haptics/geometry/triangle_query.hpp"

namespace reckon::haptics {

namespace {

using Eigen::Vector3d;

// Distance from the goal at which friction holds an SCP under `load`. @param lateral present
// distance
double stay(FrictionCone* friction, double lateral, double load) {
  if (friction == nullptr) return 0.0;
  const double held = friction->held(lateral, load, friction->sliding());
  friction->set_sliding(held < lateral);
  return held;
}

// [m], for a surface without a size.
constexpr double kPlaneClearance = 1e-9;
// Share of the clearance between the stop of a sweep and the settled SCP.
constexpr double kMargin = 1.0 - kStopShare;

// Projects onto a sphere around the origin.
Vector3d radially(const Vector3d& p, double reach) {
  const double distance = p.norm();
  return distance > 0.0 ? Vector3d(p * (reach / distance)) : Vector3d(0.0, 0.0, reach);
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

bool HalfSpace::contains(const Vector3d& p, double radius) const noexcept {
  return normal_.dot(p) < radius;
}

Vector3d HalfSpace::nearest_outside(const Vector3d& p, double radius) const noexcept {
  return p + (radius - normal_.dot(p)) * normal_;
}

SettledPoint HalfSpace::settle(const Vector3d& scp, const Vector3d& device, FrictionCone* friction,
                               double radius) const noexcept {
  const double depth = radius - normal_.dot(device);
  if (!(depth > 0.0)) return free_at(device, friction);
  // From free space the SCP lands where the straight path meets the plane.
  const double height = std::max(normal_.dot(scp) - radius, 0.0);
  const Vector3d landed = nearest_outside(scp + height / (height + depth) * (device - scp), radius);
  const Vector3d goal = nearest_outside(device, radius);
  const double lateral = (landed - goal).norm();
  const double held = stay(friction, lateral, depth);
  if (held >= lateral) return {landed, normal_, true};
  return {goal + held / lateral * (landed - goal), normal_, true};
}

// Its inside is unbounded: a probe at any depth overlaps it and goes no deeper.
bool HalfSpace::sweep(const Vector3d& origin, const Vector3d& step, double radius,
                      SweepHit& hit) const noexcept {
  const double height = normal_.dot(origin) - radius;
  const double change = normal_.dot(step);
  if (height > 0.0 ? height + change >= 0.0 : -change <= kSlideSlack * kPlaneClearance)
    return false;
  hit = {height > 0.0 ? height / -change : 0.0, normal_, 0.0, 0, 0, true};
  return true;
}

double HalfSpace::distance_below(const Vector3d& p) const noexcept { return normal_.dot(p); }

double HalfSpace::clearance() const noexcept { return kPlaneClearance; }

Vector3d HalfSpace::nearest_inside(const Vector3d& p) const noexcept {
  const double over = normal_.dot(p);
  return over > 0.0 ? Vector3d(p - over * normal_) : p;
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

bool Ball::contains(const Vector3d& p, double radius) const noexcept {
  return p.norm() < radius_ + radius;
}

Vector3d Ball::nearest_outside(const Vector3d& p, double radius) const noexcept {
  return radially(p, radius_ + radius);
}

// First point of the path that lies on the ball.
bool Ball::lands(const Vector3d& from, const Vector3d& to, double reach,
                 Vector3d& at) const noexcept {
  const Vector3d way = to - from;
  const double way_squared = way.squaredNorm();
  const double inward = -from.dot(way);
  if (!(inward > 0.0) || !(way_squared > 0.0)) return false;
  const double nearest_t = inward / way_squared;
  const double half_chord = reach * reach - (from + nearest_t * way).squaredNorm();
  if (half_chord <= 0.0) return false;
  const double t = nearest_t - std::sqrt(half_chord / way_squared);
  if (t > 1.0) return false;
  at = radially(from + std::max(t, 0.0) * way, reach);
  return true;
}

SettledPoint Ball::settle(const Vector3d& scp, const Vector3d& device, FrictionCone* friction,
                          double radius) const noexcept {
  const double reach = radius_ + radius;
  Vector3d landed;
  if (!lands(scp, device, reach, landed)) return free_at(device, friction);
  const double distance = device.norm();
  const bool outside = distance >= reach;
  if (friction == nullptr) {
    if (outside) return free_at(device, friction);
    if (!(distance > 1e-12 * reach)) return {landed, landed / reach, true};
    return {radially(device, reach), device / distance, true};
  }

  // In the plane of landed and device, at the angle between them: tangential d sin a, normal R - d
  // cos a. Sliding stops where the tangential part is the kinetic coefficient times the normal
  // part.
  const Vector3d up = landed / reach;
  const double height = device.dot(up);
  const Vector3d across = device - height * up;
  const double lateral = across.norm();
  const double load = reach - height;
  const bool slides = lateral > friction->coefficient(friction->sliding()) * load;
  friction->set_sliding(slides);
  if (!slides) return {landed, up, true};
  const double mu = friction->kinetic();
  const double sine = mu * reach / (distance * std::sqrt(1.0 + mu * mu));
  const double rest = sine < 1.0 ? std::asin(sine) - std::atan(mu) : 0.0;
  if (rest <= 0.0 && outside) return free_at(device, friction);
  const Vector3d towards = radially(device, reach) / reach;
  const Vector3d side = (up - up.dot(towards) * towards).normalized();
  const double angle = std::max(rest, 0.0);
  const Vector3d normal = std::cos(angle) * towards + std::sin(angle) * side;
  return {reach * normal, normal, true};
}

bool Ball::sweep(const Vector3d& origin, const Vector3d& step, double radius,
                 SweepHit& hit) const noexcept {
  const double reach = radius_ + radius;
  const Sweep way{origin, step, reach, reach - clearance(), kSlideSlack * clearance()};
  TriangleHit found;
  if (!sweep_corner(Vector3d::Zero(), way, 1.0, found)) return false;
  hit = {found.t, found.normal, kMargin * clearance(), 0, 0, false};
  return true;
}

double Ball::distance_below(const Vector3d& p) const noexcept { return p.norm() - radius_; }

double Ball::clearance() const noexcept { return 2.0 * kRelativeClearance * radius_; }

Vector3d Ball::nearest_inside(const Vector3d& p) const noexcept {
  const double distance = p.norm();
  return distance > radius_ ? Vector3d((radius_ / distance) * p) : p;
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

bool Block::contains(const Vector3d& p, double radius) const noexcept {
  if (radius > 0.0 && distance_below(p) < radius) return true;
  return (p.cwiseAbs().array() < half_.array() + std::min(radius, 0.0)).all();
}

Vector3d Block::nearest_outside(const Vector3d& p, double radius) const noexcept {
  Eigen::Index axis = 0;
  (half_ - p.cwiseAbs()).minCoeff(&axis);
  Vector3d out = p;
  out[axis] = std::copysign(half_[axis] + clearance_ + radius, p[axis]);
  return out;
}

// Axis of the face through which the path enters the box grown by 0.99 clearances; -1 for none.
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

  // Land one clearance above the face and slide on that plane. Beyond the face's border the SCP is
  // free, because the device is beyond it too.
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

// Sweeps its faces as triangles, which round the edges and corners.
bool Block::sweep(const Vector3d& origin, const Vector3d& step, double radius,
                  SweepHit& hit) const noexcept {
  const double stop = kStopShare * clearance_;
  const Sweep way{origin, step, radius + stop, radius + 0.5 * stop, kSlideSlack * clearance_};
  double limit = 1.0;
  bool found = false;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const std::array<Vector3d, 4> corners = face_corners(face);
    const Vector3d normal = (face % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(face / 2);
    for (std::uint32_t half = 0; half < 2; ++half) {
      const Triangle triangle{corners[0], corners[1 + half], corners[2 + half], normal};
      TriangleHit one;
      if (!sweep_triangle(triangle, way, limit, one) || (found && one.t >= limit)) continue;
      hit = {one.t, one.normal, clearance_ - stop, 2 * face + half, 0, one.on_face};
      limit = one.t;
      found = true;
    }
  }
  return found;
}

// Counter-clockwise as seen from outside.
std::array<Vector3d, 4> Block::face_corners(std::uint32_t face) const noexcept {
  const Eigen::Index axis = face / 2;
  const Eigen::Index u = (axis + 1) % 3;
  const Eigen::Index v = (axis + 2) % 3;
  const double sign = face % 2 == 0 ? 1.0 : -1.0;
  std::array<Vector3d, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i][axis] = sign * half_[axis];
    corners[i][u] = (i == 1 || i == 2 ? sign : -sign) * half_[u];
    corners[i][v] = (i < 2 ? -1.0 : 1.0) * half_[v];
  }
  return corners;
}

double Block::distance_below(const Vector3d& p) const noexcept {
  return (p.cwiseAbs() - half_).cwiseMax(0.0).norm();
}

double Block::clearance() const noexcept { return clearance_; }

Vector3d Block::nearest_inside(const Vector3d& p) const noexcept {
  return p.cwiseMax(-half_).cwiseMin(half_);
}

Eigen::AlignedBox3d Block::bounds() const noexcept { return {-half_, half_}; }

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/implicit_solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace reckon::haptics {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

constexpr double kLeastClearance = 4e-10;     // [m]
constexpr double kImplicitClearance = 1e-10;  // of the size
constexpr double kReached = 2e-3;             // [clearances] above the stop of a sweep
constexpr double kFloorShare = 0.5;           // of the clearance; nothing passes nearer
constexpr double kLeastApproach = 1e-6;       // least share of a path along its obstacle's normal
constexpr double kCutRoom = 1e-3;             // of the size, around the bounds
constexpr double kLongestStretch = 4.0;       // [sizes], range of the search for an SCP outside
constexpr int kMostClimbs = 64;
// Samples after which a path that is slow at first counts as parallel to a surface: the remaining
// samples would not help.
constexpr int kFirstSamples = 6;
constexpr double kSlow = 1e-3;
constexpr double kSteep = 0.2;  // at such a slope the remaining samples suffice

void need(bool holds, const char* remedy) {
  if (!holds) throw std::invalid_argument(remedy);
}

bool is_length(double value) { return value > 0.0 && std::isfinite(value); }

HalfSpaceFunction function_of(const PlaneShape& shape) {
  need(shape.normal.allFinite() && shape.normal.norm() > 0.0,
       "plane: normal must be finite and not zero; give e.g. [0, 0, 1]");
  return {shape.normal.normalized()};
}

SphereFunction function_of(const SphereShape& shape) {
  need(is_length(shape.radius), "sphere: radius must be finite and above 0 m");
  return {shape.radius};
}

BoxFunction function_of(const BoxShape& shape) {
  need(shape.size.allFinite() && shape.size.minCoeff() > 0.0,
       "box: each of the three sizes must be finite and above 0 m");
  return {0.5 * shape.size};
}

CylinderFunction function_of(const CylinderShape& shape) {
  need(is_length(shape.radius) && is_length(shape.height),
       "cylinder: radius and height must be finite and above 0 m");
  return {shape.radius, 0.5 * shape.height};
}

ConeFunction function_of(const ConeShape& shape) {
  const bool radii =
      shape.radius >= 0.0 && shape.top_radius >= 0.0 && is_length(shape.radius + shape.top_radius);
  need(radii && is_length(shape.height),
       "cone: height must be finite and above 0 m, and so must radius or top_radius");
  return {shape.radius, shape.top_radius, 0.5 * shape.height};
}

TorusFunction function_of(const TorusShape& shape) {
  need(is_length(shape.tube) && std::isfinite(shape.radius) && shape.radius > shape.tube,
       "torus: tube must be above 0 m, and radius (to the centre of the tube) above tube");
  return {shape.radius, shape.tube};
}

EllipsoidFunction function_of(const EllipsoidShape& shape) {
  need(shape.semi_axes.allFinite() && shape.semi_axes.minCoeff() > 0.0,
       "ellipsoid: each of the three semi-axes must be finite and above 0 m");
  return {shape.semi_axes};
}

SignedFunction function_of(const CsgPart& part) {
  need(part.position.allFinite() && part.orientation.coeffs().allFinite() &&
           part.orientation.norm() > 0.0,
       "the pose of a part must be finite, with a non-zero orientation");
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = part.orientation.normalized().toRotationMatrix();
  place.translation() = part.position;
  return std::visit(
      [&](const auto& shape) { return SignedFunction(Primitive(function_of(shape)), place); },
      part.shape);
}

SignedFunction joined(const SignedFunction& before, const CsgPart& part) {
  const SignedFunction own = function_of(part);
  switch (part.operation) {
    case CsgOperation::subtract:
      return subtract(before, own, part.rounding);
    case CsgOperation::intersect:
      return intersect(before, own, part.rounding);
    default:
      return unite(before, own, part.rounding);
  }
}

SignedFunction function_of(const CsgShape& shape) {
  need(!shape.parts.empty() && shape.parts.front().operation == CsgOperation::add,
       "a solid needs parts, and the first one must be an addition");
  SignedFunction whole = function_of(shape.parts.front());
  for (std::size_t i = 1; i < shape.parts.size(); ++i) whole = joined(whole, shape.parts[i]);
  return whole;
}

std::string named(const CsgShape& shape) {
  return "solid of " + std::to_string(shape.parts.size()) +
         (shape.parts.size() == 1 ? " part" : " parts");
}

}  // namespace

ImplicitSolid::ImplicitSolid(SignedFunction function, std::string what)
    : function_(std::move(function)), what_(std::move(what)), cut_(function_.bounds()) {
  need(!cut_.isEmpty(), "its parts leave no volume; check its intersections");
  if (cut_.sizes().allFinite()) size_ = cut_.sizes().norm();
  clearance_ = std::max(kLeastClearance, kImplicitClearance * size_);
  const Vector3d room = Vector3d::Constant(kCutRoom * size_);
  if (!function_.exact_outside()) cut_ = AlignedBox3d(cut_.min() - room, cut_.max() + room);
}

ImplicitSolid::ImplicitSolid(const CylinderShape& shape)
    : ImplicitSolid(SignedFunction(function_of(shape)), "cylinder") {
  cylinder_ = shape;
}
ImplicitSolid::ImplicitSolid(const ConeShape& shape)
    : ImplicitSolid(SignedFunction(function_of(shape)), "cone") {}
ImplicitSolid::ImplicitSolid(const TorusShape& shape)
    : ImplicitSolid(SignedFunction(function_of(shape)), "torus") {}
ImplicitSolid::ImplicitSolid(const EllipsoidShape& shape)
    : ImplicitSolid(SignedFunction(function_of(shape)), "ellipsoid") {}
ImplicitSolid::ImplicitSolid(const CsgShape& shape)
    : ImplicitSolid(function_of(shape), named(shape)) {}

// The solid is also its intersection with a box around it. Outside the box the distance from the
// box is a bound too, and the better one beside a sharp mitre.
SignedSample ImplicitSolid::sample(const Vector3d& p) const noexcept {
  const SignedSample own = function_.sample(p);
  if (function_.exact_outside() || cut_.contains(p)) return own;
  const double outside = cut_.exteriorDistance(p);
  if (!(outside > own.value)) return own;
  const Vector3d foot = p.cwiseMax(cut_.min()).cwiseMin(cut_.max());
  return {outside, (p - foot) / outside};
}

WaySample ImplicitSolid::sample_along(const Vector3d& p, const Vector3d& direction,
                                      double level) const noexcept {
  WaySample own = function_.sample_along(p, direction, level, clearance_);
  if (function_.exact_outside() || cut_.contains(p)) return own;
  const double outside = cut_.exteriorDistance(p);
  own.advance = std::max(own.advance, outside - level);
  if (!(outside > own.value)) return own;
  const Vector3d foot = p.cwiseMax(cut_.min()).cwiseMin(cut_.max());
  own.value = outside;
  own.gradient = (p - foot) / outside;
  return own;
}

bool ImplicitSolid::contains(const Vector3d& p, double radius) const noexcept {
  return sample(p).value < radius;
}

double ImplicitSolid::distance_below(const Vector3d& p) const noexcept { return sample(p).value; }

// Newton's method along the gradient, which is shorter than 1 at rounded edges.
bool ImplicitSolid::climb_out(Vector3d& p, double radius) const noexcept {
  for (int i = 0; i < kMostClimbs; ++i) {
    const SignedSample here = sample(p);
    const double missing = radius + clearance_ - here.value;
    if (missing <= kReached * clearance_) return true;
    const double steepness = here.gradient.squaredNorm();
    p += std::min(missing / std::max(steepness, 0.1), size_) * here.gradient;
  }
  return sample(p).value >= radius + kFloorShare * clearance_;
}

// If the gradient gives no direction, as at the very centre: inwards from outside, along an axis.
Vector3d ImplicitSolid::nearest_outside(const Vector3d& p, double radius) const noexcept {
  Vector3d climbed = p;
  if (climb_out(climbed, radius)) return climbed;
  Vector3d best = p;
  double least = std::numeric_limits<double>::infinity();
  for (int way = 0; way < 6; ++way) {
    const Vector3d out = (way % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit(way / 2);
    for (double reach = clearance_; reach < kLongestStretch * (size_ + radius); reach *= 2.0) {
      const Vector3d start = p + reach * out;
      if (contains(start, radius + clearance_)) continue;
      if (reach < least) best = start;
      least = std::min(least, reach);
      break;
    }
  }
  return best;
}

// Advances by the distance that f proves to be free until f is down to the stop. If f is below it
// at the start, rounding may have moved the SCP there, and only motion towards the surface is
// blocked.
bool ImplicitSolid::sweep(const Vector3d& origin, const Vector3d& step, double radius,
                          SweepHit& hit) const noexcept {
  const double length = step.norm();
  if (!(length > 0.0)) return false;
  const Vector3d direction = step / length;
  const double stop = radius + kStopShare * clearance_;
  const double slack = kSlideSlack * clearance_;
  double level = stop;
  double reached = kReached * clearance_;
  double way = 0.0;
  WaySample here = sample_along(origin, direction, level);
  if (here.value - level <= reached) {
    const double granted = here.value > radius + kFloorShare * clearance_ ? slack : 0.0;
    if (-here.gradient.dot(step) > granted) {
      hit = hit_at(0.0, here.gradient, direction);
      return true;
    }
    level = here.value - slack;
    reached = 0.5 * slack;
    here = sample_along(origin, direction, level);
  }
  for (int i = 1; i < kMostSamples && here.value - level > reached; ++i) {
    const bool along = here.gradient.dot(direction) > -kSteep * here.gradient.norm();
    if (along && i > kFirstSamples && way < kSlow * length) break;
    way += here.advance;
    if (!(way < length)) return false;
    here = sample_along(origin + way * direction, direction, level);
  }
  hit = hit_at(way / length, here.gradient, direction);
  return true;
}

SweepHit ImplicitSolid::hit_at(double t, const Vector3d& gradient,
                               const Vector3d& direction) const noexcept {
  Vector3d normal = gradient.squaredNorm() > 0.0 ? Vector3d(gradient.normalized()) : -direction;
  const double along = normal.dot(direction);
  if (along > -kLeastApproach) {
    normal = (normal - (along + kLeastApproach) * direction).normalized();
  }
  SweepHit hit;
  hit.t = t;
  hit.normal = normal;
  hit.margin = (1.0 - kStopShare) * clearance_;
  hit.curved = true;
  return hit;
}

}  // namespace reckon::haptics

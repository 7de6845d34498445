// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/implicit/primitives.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::haptics {

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// A body of revolution about z is a figure in the half plane of (distance from the axis, z).
struct FlatSample {
  double value;
  Vector2d gradient;
};

double from_axis(const Vector3d& p) { return std::sqrt(p.x() * p.x() + p.y() * p.y()); }

SignedSample revolved(const Vector3d& p, double rho, const FlatSample& flat) {
  const Vector2d out = rho > 0.0 ? Vector2d(p.head<2>() / rho) : Vector2d::UnitX();
  const Vector2d across = flat.gradient.x() * out;
  return {flat.value, {across.x(), across.y(), flat.gradient.y()}};
}

FlatSample from_corner(const Vector2d& offset) {
  const double distance = offset.norm();
  return {distance, distance > 0.0 ? Vector2d(offset / distance) : Vector2d::UnitX()};
}

AlignedBox3d round_bounds(double radius, double half) {
  return {Vector3d(-radius, -radius, -half), Vector3d(radius, radius, half)};
}

}  // namespace

SignedSample HalfSpaceFunction::sample(const Vector3d& p) const noexcept {
  return {normal.dot(p), normal};
}

AlignedBox3d HalfSpaceFunction::bounds() const noexcept {
  const Vector3d all = Vector3d::Constant(std::numeric_limits<double>::infinity());
  return {-all, all};
}

SignedSample SphereFunction::sample(const Vector3d& p) const noexcept {
  const double distance = p.norm();
  return {distance - radius, distance > 0.0 ? Vector3d(p / distance) : Vector3d::UnitZ()};
}

AlignedBox3d SphereFunction::bounds() const noexcept {
  return {Vector3d::Constant(-radius), Vector3d::Constant(radius)};
}

SignedSample BoxFunction::sample(const Vector3d& p) const noexcept {
  const Vector3d beyond = p.cwiseAbs() - half;
  Eigen::Index axis = 0;
  const double most = beyond.maxCoeff(&axis);
  Vector3d gradient = Vector3d::Zero();
  if (most <= 0.0) {
    gradient[axis] = std::copysign(1.0, p[axis]);
    return {most, gradient};
  }
  const Vector3d out = beyond.cwiseMax(0.0);
  const double distance = out.norm();
  for (Eigen::Index i = 0; i < 3; ++i) gradient[i] = std::copysign(out[i] / distance, p[i]);
  return {distance, gradient};
}

AlignedBox3d BoxFunction::bounds() const noexcept { return {-half, half}; }

SignedSample CylinderFunction::sample(const Vector3d& p) const noexcept {
  const double rho = from_axis(p);
  const double up = std::copysign(1.0, p.z());
  const Vector2d beyond(rho - radius, std::abs(p.z()) - half);
  if (beyond.minCoeff() > 0.0) {
    const FlatSample corner = from_corner(beyond);
    return revolved(p, rho, {corner.value, {corner.gradient.x(), up * corner.gradient.y()}});
  }
  if (beyond.x() > beyond.y()) return revolved(p, rho, {beyond.x(), Vector2d::UnitX()});
  return revolved(p, rho, {beyond.y(), {0.0, up}});
}

AlignedBox3d CylinderFunction::bounds() const noexcept { return round_bounds(radius, half); }

// The figure is a trapezium. From outside, the nearest of its sides or else of its corners counts;
// from inside, the nearest side.
SignedSample ConeFunction::sample(const Vector3d& p) const noexcept {
  const double rho = from_axis(p);
  const Vector2d at(rho, p.z());
  const Vector2d lower(base, -half);
  const Vector2d upper(top, half);
  const Vector2d flank = upper - lower;
  const double length = flank.norm();
  const Vector2d normal(flank.y() / length, -flank.x() / length);
  const double side = normal.dot(at - lower);
  const double along = flank.dot(at - lower) / length;
  const double below = -half - p.z();
  const double above = p.z() - half;
  const FlatSample floor{below, -Vector2d::UnitY()};
  const FlatSample ceiling{above, Vector2d::UnitY()};
  const FlatSample slope{side, normal};
  if (side <= 0.0 && below <= 0.0 && above <= 0.0) {
    if (side >= below && side >= above) return revolved(p, rho, slope);
    return revolved(p, rho, below >= above ? floor : ceiling);
  }
  if (below > 0.0 && rho <= base) return revolved(p, rho, floor);
  if (above > 0.0 && rho <= top) return revolved(p, rho, ceiling);
  if (along < 0.0) return revolved(p, rho, from_corner(at - lower));
  if (along > length) return revolved(p, rho, from_corner(at - upper));
  return revolved(p, rho, slope);
}

AlignedBox3d ConeFunction::bounds() const noexcept {
  return round_bounds(std::max(base, top), half);
}

SignedSample TorusFunction::sample(const Vector3d& p) const noexcept {
  const double rho = from_axis(p);
  const FlatSample circle = from_corner({rho - radius, p.z()});
  return revolved(p, rho, {circle.value - tube, circle.gradient});
}

AlignedBox3d TorusFunction::bounds() const noexcept { return round_bounds(radius + tube, tube); }

// The foot q of p has p - q along the normal: q_i = a_i^2 p_i / (a_i^2 + t), and t is the greatest
// root of sum (a_i p_i / (a_i^2 + t))^2 = 1 (D. Eberly, Distance from a Point to an Ellipsoid).
// Left of that root the sum is convex and decreasing, so that Newton's method approaches it from
// below.
SignedSample EllipsoidFunction::sample(const Vector3d& p) const noexcept {
  constexpr double kOffPlane = 1e-14;  // of an axis: keeps a point off a plane of symmetry
  constexpr int kMostSteps = 100;
  const Vector3d squares = semi.cwiseAbs2();
  const Vector3d place = p.cwiseAbs().cwiseMax(kOffPlane * semi);
  const Vector3d product = semi.cwiseProduct(place);
  double t = (product - squares).maxCoeff();
  for (int i = 0; i < kMostSteps; ++i) {
    const Vector3d inverse = (squares.array() + t).inverse();
    const Vector3d terms = product.cwiseProduct(inverse).cwiseAbs2();
    const double slope = 2.0 * terms.dot(inverse);
    const double next = t + (terms.sum() - 1.0) / slope;
    if (!(next > t)) break;
    t = next;
  }
  const Vector3d steep = place.cwiseQuotient((squares.array() + t).matrix());  // q_i / a_i^2
  const double size = steep.norm();
  Vector3d gradient;
  for (Eigen::Index i = 0; i < 3; ++i) gradient[i] = std::copysign(steep[i] / size, p[i]);
  return {t * size, gradient};
}

AlignedBox3d EllipsoidFunction::bounds() const noexcept { return {-semi, semi}; }

}  // namespace reckon::haptics

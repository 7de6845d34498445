// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_kinematics.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using G = FalconGeometry;

constexpr double kFirst = 35.0;                                  // [deg], at count 0
constexpr double kStep = 360.0 / (320.0 * 4.0) * 14.25 / 110.0;  // [deg]
constexpr double kRadian = std::numbers::pi / 180.0;
constexpr int kMostSteps = 12;
constexpr double kNear = 1e-6;  // [m]: after such a step the next Newton step is below 1e-11
// Share of the greatest volume that the three rods can span. Below it, small errors of the angles
// become large errors of the position.
constexpr double kLeastVolume = 0.05;
constexpr double kLeastLever = 0.1;  // share of the arm's length

// A leg's own axes: u outwards, v across, w along the device's axis.
struct Leg {
  double cosine, sine;
};
const std::array<Leg, 3>& legs() {
  static const std::array<Leg, 3> kAll{Leg{std::cos(G::kLegs[0]), std::sin(G::kLegs[0])},
                                       Leg{std::cos(G::kLegs[1]), std::sin(G::kLegs[1])},
                                       Leg{std::cos(G::kLegs[2]), std::sin(G::kLegs[2])}};
  return kAll;
}

// The end of an arm, shifted so that the parallelogram leads to the middle of the handle.
Vector3d knee(const Leg& leg, double cosine, double sine) {
  const double u = G::kAxis - G::kHandle + G::kArm * cosine;
  return {leg.cosine * u - leg.sine * G::kAside, leg.sine * u + leg.cosine * G::kAside,
          G::kArm * sine};
}

// Vector from a knee to the handle in the leg's axes. The middle of the parallelogram's far end is
// on a torus about the knee, of radii kJoints (major) and kRod (minor).
struct Rod {
  double u, v, w;
  double fold;   // [m], across the knee's axis
  double share;  // share of (u, w) along the minor circle
};
Rod rod_of(const Leg& leg, const Vector3d& q) {
  Rod rod{leg.cosine * q.x() + leg.sine * q.y(), leg.cosine * q.y() - leg.sine * q.x(), q.z(), 0,
          0};
  rod.fold = std::sqrt(rod.u * rod.u + rod.w * rod.w);
  rod.share = 1.0 - G::kJoints / rod.fold;
  return rod;
}

// Half the gradient of the torus' equation: a vector along the rod, of its length.
Vector3d along(const Leg& leg, const Rod& rod) {
  const double u = rod.share * rod.u;
  return {leg.cosine * u - leg.sine * rod.v, leg.sine * u + leg.cosine * rod.v, rod.share * rod.w};
}

// The upper point at the distance kRod + kJoints from each knee; if none exists, the point in the
// plane of the knees with equal distances.
Vector3d sphere_point(const std::array<Vector3d, 3>& knees) {
  constexpr double kLength = G::kRod + G::kJoints;
  const Vector3d a = knees[1] - knees[0];
  const Vector3d b = knees[2] - knees[0];
  const Vector3d n = a.cross(b);
  const double area = n.squaredNorm();
  const Vector3d middle =
      (a.squaredNorm() * b.cross(n) + b.squaredNorm() * n.cross(a)) / (2.0 * area);
  const double left = std::max(0.0, kLength * kLength - middle.squaredNorm());
  const double up = n.z() < 0 ? -1.0 : 1.0;
  return knees[0] + middle + up * std::sqrt(left / area) * n;
}

}  // namespace

double falcon_count_step() noexcept { return kStep * kRadian; }

double falcon_angle(std::int16_t count) noexcept {
  return (kFirst + kStep * static_cast<double>(count)) * kRadian;
}

std::int16_t falcon_count(double angle) noexcept {
  using Limits = std::numeric_limits<std::int16_t>;
  const double count = std::round((angle / kRadian - kFirst) / kStep);
  if (!(count > Limits::min())) return Limits::min();
  return static_cast<std::int16_t>(std::min<double>(count, Limits::max()));
}

std::optional<FalconPose> falcon_pose(const Vector3d& angles) noexcept {
  if (!angles.allFinite()) return std::nullopt;
  const Eigen::Array3d cosines = angles.array().cos();
  const Eigen::Array3d sines = angles.array().sin();
  std::array<Vector3d, 3> knees;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    knees[k] = knee(legs()[k], cosines[i], sines[i]);
  }
  FalconPose pose;
  pose.position = sphere_point(knees);

  Matrix3d rods;
  bool last = false;
  for (int step = 0; step < kMostSteps; ++step) {
    Vector3d off;
    Vector3d levers;
    double least_share = 1.0;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Rod rod = rod_of(legs()[k], pose.position - knees[k]);
      const double circle = rod.fold - G::kJoints;
      off[i] = 0.5 * (G::kRod * G::kRod - circle * circle - rod.v * rod.v);
      rods.row(i) = along(legs()[k], rod);
      least_share = std::min(least_share, rod.share);
      levers[i] = G::kArm * rod.share * (rod.w * cosines[i] - rod.u * sines[i]);
    }
    const double volume = rods.determinant();
    // Written so that not-a-number is refused.
    if (!(std::abs(volume) > kLeastVolume * G::kRod * G::kRod * G::kRod)) return std::nullopt;
    const Matrix3d ways = rods.inverse();
    if (last) {
      // Another assembly mode: a parallelogram or an arm folded inwards.
      if (!(least_share > 0)) return std::nullopt;
      if (!(levers.minCoeff() > kLeastLever * G::kArm * G::kRod)) return std::nullopt;
      pose.jacobian = ways * levers.asDiagonal();
      return pose;
    }
    const Vector3d change = ways * off;
    pose.position += change;
    last = change.squaredNorm() < kNear * kNear;
  }
  return std::nullopt;
}

std::optional<Vector3d> falcon_angles(const Vector3d& position) noexcept {
  Vector3d angles;
  for (int i = 0; i < 3; ++i) {
    const Leg& leg = legs()[static_cast<std::size_t>(i)];
    const double u = leg.cosine * position.x() + leg.sine * position.y() - G::kAxis + G::kHandle;
    const double v = leg.cosine * position.y() - leg.sine * position.x() - G::kAside;
    const double w = position.z();
    const double circle = std::sqrt(G::kRod * G::kRod - v * v);
    const double fold = G::kJoints + circle;
    const double reach = std::sqrt(u * u + w * w);
    // Triangle of arm, parallelogram and the line from the arm's axis; the knee is outwards.
    const double inside = (G::kArm * G::kArm + reach * reach - fold * fold) / (2 * G::kArm * reach);
    angles[i] = std::atan2(w, u) - std::acos(inside);
  }
  if (!angles.allFinite()) return std::nullopt;
  return angles;
}

}  // namespace reckon::haptics

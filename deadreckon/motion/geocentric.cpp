// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/geocentric.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace reckon::deadreckon {

namespace {

constexpr double kSemiMajorAxis = 6378137.0;         // WGS84 [m]
constexpr double kFlattening = 1.0 / 298.257223563;  // WGS84
constexpr double kEccentricitySquared = kFlattening * (2.0 - kFlattening);
constexpr double kLargestHeight = 1e8;  // [m]

// Columns east, north, up.
Eigen::Matrix3d east_north_up(double latitude, double longitude) {
  const double sp = std::sin(latitude), cp = std::cos(latitude);
  const double sl = std::sin(longitude), cl = std::cos(longitude);
  Eigen::Matrix3d axes;
  axes << -sl, -sp * cl, cp * cl,  //
      cl, -sp * sl, cp * sl,       //
      0.0, cp, sp;
  return axes;
}

double checked(double value, double limit, const char* what) {
  if (std::abs(value) <= limit) return value;
  throw std::invalid_argument(std::string(what) + " of the scene's origin is " +
                              std::to_string(value) + "; it must lie within +-" +
                              std::to_string(limit));
}

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

}  // namespace

Eigen::Quaterniond quaternion_from_euler(const Euler& euler) noexcept {
  const double sa = std::sin(0.5 * euler.psi), ca = std::cos(0.5 * euler.psi);
  const double sb = std::sin(0.5 * euler.theta), cb = std::cos(0.5 * euler.theta);
  const double sc = std::sin(0.5 * euler.phi), cc = std::cos(0.5 * euler.phi);
  return {ca * cb * cc + sa * sb * sc, ca * cb * sc - sa * sb * cc, ca * sb * cc + sa * cb * sc,
          sa * cb * cc - ca * sb * sc};
}

Euler euler_from_quaternion(const Eigen::Quaterniond& q) noexcept {
  // From the products above: w-y, x+z = (cos B - sin B) (cos, sin)(A + C) and
  // w+y, z-x = (cos B + sin B) (cos, sin)(A - C), with A, B, C half of psi, theta, phi. Near
  // theta = +-pi/2 one pair vanishes and the other keeps all its digits.
  const double minus = std::hypot(q.x() + q.z(), q.w() - q.y());
  const double plus = std::hypot(q.z() - q.x(), q.w() + q.y());
  double sum = std::atan2(q.x() + q.z(), q.w() - q.y());
  double difference = std::atan2(q.z() - q.x(), q.w() + q.y());
  constexpr double kRounding = 1e-15;
  if (minus < kRounding) sum = difference;  // facing straight up: phi = 0
  if (plus < kRounding) difference = sum;   // facing straight down: phi = 0
  return {wrapped(sum + difference), 2.0 * std::atan2(plus, minus) - 0.5 * std::numbers::pi,
          wrapped(sum - difference)};
}

Eigen::Vector3d geocentric_position(double latitude, double longitude, double height) noexcept {
  const double sp = std::sin(latitude), cp = std::cos(latitude);
  const double normal = kSemiMajorAxis / std::sqrt(1.0 - kEccentricitySquared * sp * sp);
  return {(normal + height) * cp * std::cos(longitude),
          (normal + height) * cp * std::sin(longitude),
          (normal * (1.0 - kEccentricitySquared) + height) * sp};
}

LocalFrame::LocalFrame(double latitude, double longitude, double height) {
  checked(latitude, 0.5 * std::numbers::pi, "latitude [rad]");
  checked(longitude, 2.0 * std::numbers::pi, "longitude [rad]");
  checked(height, kLargestHeight, "height [m]");
  origin_ = geocentric_position(latitude, longitude, height);
  rotation_ = east_north_up(latitude, longitude);
  quaternion_ = Eigen::Quaterniond(rotation_).normalized();
}

}  // namespace reckon::deadreckon

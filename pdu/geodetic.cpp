// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/geodetic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reckon::pdu {
namespace {

constexpr double kRadian = 180.0 / std::numbers::pi;  // degrees

// WGS84.
constexpr double kSemiMajor = 6378137.0;  // m
constexpr double kFlattening = 1.0 / 298.257223563;
constexpr double kSemiMinor = kSemiMajor * (1.0 - kFlattening);
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
constexpr double kSecondEccentricity2 = kEccentricity2 / (1.0 - kEccentricity2);

constexpr double kLeastRadius = 1e6;  // m

struct Vector {
  double x = 0, y = 0, z = 0;
};
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

std::optional<Geodetic> geodetic_from(const WorldCoordinates& location) noexcept {
  const auto [x, y, z] = location;
  const double radius = std::hypot(x, y, z);
  if (!std::isfinite(radius) || radius < kLeastRadius) return std::nullopt;

  // Bowring's formula, begun with the parametric latitude and repeated twice.
  const double p = std::hypot(x, y);
  double parametric = std::atan2(kSemiMajor * z, kSemiMinor * p);
  double latitude = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double sine = std::sin(parametric);
    const double cosine = std::cos(parametric);
    latitude = std::atan2(z + kSecondEccentricity2 * kSemiMinor * sine * sine * sine,
                          p - kEccentricity2 * kSemiMajor * cosine * cosine * cosine);
    parametric = std::atan2((1.0 - kFlattening) * std::sin(latitude), std::cos(latitude));
  }
  const double sine = std::sin(latitude);
  const double height = p * std::cos(latitude) + z * sine -
                        kSemiMajor * std::sqrt(1.0 - kEccentricity2 * sine * sine);
  return Geodetic{latitude * kRadian, std::atan2(y, x) * kRadian, height};
}

std::optional<Attitude> attitude_from(const EulerAngles& orientation,
                                      const Geodetic& place) noexcept {
  const double psi = orientation.psi;
  const double theta = orientation.theta;
  const double phi = orientation.phi;
  if (!std::isfinite(psi + theta + phi)) return std::nullopt;
  // Body axes in W: x forward, y right, z down.
  const Vector forward{std::cos(theta) * std::cos(psi), std::cos(theta) * std::sin(psi),
                       -std::sin(theta)};
  const Vector right{
      std::sin(phi) * std::sin(theta) * std::cos(psi) - std::cos(phi) * std::sin(psi),
      std::sin(phi) * std::sin(theta) * std::sin(psi) + std::cos(phi) * std::cos(psi),
      std::sin(phi) * std::cos(theta)};
  const Vector down{std::cos(phi) * std::sin(theta) * std::cos(psi) + std::sin(phi) * std::sin(psi),
                    std::cos(phi) * std::sin(theta) * std::sin(psi) - std::sin(phi) * std::cos(psi),
                    std::cos(phi) * std::cos(theta)};
  const double latitude = place.latitude_deg / kRadian;
  const double longitude = place.longitude_deg / kRadian;
  const Vector north{-std::sin(latitude) * std::cos(longitude),
                     -std::sin(latitude) * std::sin(longitude), std::cos(latitude)};
  const Vector east{-std::sin(longitude), std::cos(longitude), 0.0};
  const Vector up{std::cos(latitude) * std::cos(longitude),
                  std::cos(latitude) * std::sin(longitude), std::sin(latitude)};

  double heading = std::atan2(dot(forward, east), dot(forward, north)) * kRadian;
  if (heading < 0.0) heading += 360.0;
  return Attitude{heading, std::asin(std::clamp(dot(forward, up), -1.0, 1.0)) * kRadian,
                  std::atan2(-dot(right, up), -dot(down, up)) * kRadian};
}

}  // namespace reckon::pdu

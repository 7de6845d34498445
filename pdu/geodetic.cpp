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

/// An angle's sine and cosine; NaN for an angle that is not finite.
struct Turn {
  explicit Turn(double angle) : sine(std::sin(angle)), cosine(std::cos(angle)) {}
  double sine, cosine;
};

double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

std::optional<Geodetic> geodetic_from(const WorldCoordinates& location) noexcept {
  const auto [x, y, z] = location;
  const double radius = std::sqrt(x * x + y * y + z * z);
  if (!std::isfinite(radius) || radius < kLeastRadius) return std::nullopt;

  // Bowring's formula, begun with the parametric latitude and repeated twice. The formula gives two
  // sides of a right triangle; their ratios to the third side are sine and cosine.
  const double p = std::sqrt(x * x + y * y);
  double opposite = kSemiMajor * z;
  double adjacent = kSemiMinor * p;
  double latitude_opposite = 0.0;
  double latitude_adjacent = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double side = std::sqrt(opposite * opposite + adjacent * adjacent);
    const double sine = opposite / side;
    const double cosine = adjacent / side;
    latitude_opposite = z + kSecondEccentricity2 * kSemiMinor * sine * sine * sine;
    latitude_adjacent = p - kEccentricity2 * kSemiMajor * cosine * cosine * cosine;
    opposite = (1.0 - kFlattening) * latitude_opposite;
    adjacent = latitude_adjacent;
  }
  const double latitude = std::atan2(latitude_opposite, latitude_adjacent);
  const double side =
      std::sqrt(latitude_opposite * latitude_opposite + latitude_adjacent * latitude_adjacent);
  const double sine = latitude_opposite / side;
  const double height = p * latitude_adjacent / side + z * sine -
                        kSemiMajor * std::sqrt(1.0 - kEccentricity2 * sine * sine);
  return Geodetic{latitude * kRadian, std::atan2(y, x) * kRadian, height};
}

std::optional<Attitude> attitude_from(const EulerAngles& orientation,
                                      const Geodetic& place) noexcept {
  const Turn psi(orientation.psi);
  const Turn theta(orientation.theta);
  const Turn phi(orientation.phi);
  if (!std::isfinite(psi.sine + theta.sine + phi.sine)) return std::nullopt;
  // Body axes in W: x forward, y right, z down.
  const Vector forward{theta.cosine * psi.cosine, theta.cosine * psi.sine, -theta.sine};
  const Vector right{phi.sine * theta.sine * psi.cosine - phi.cosine * psi.sine,
                     phi.sine * theta.sine * psi.sine + phi.cosine * psi.cosine,
                     phi.sine * theta.cosine};
  const Vector down{phi.cosine * theta.sine * psi.cosine + phi.sine * psi.sine,
                    phi.cosine * theta.sine * psi.sine - phi.sine * psi.cosine,
                    phi.cosine * theta.cosine};
  const Turn latitude(place.latitude_deg / kRadian);
  const Turn longitude(place.longitude_deg / kRadian);
  const Vector north{-latitude.sine * longitude.cosine, -latitude.sine * longitude.sine,
                     latitude.cosine};
  const Vector east{-longitude.sine, longitude.cosine, 0.0};
  const Vector up{latitude.cosine * longitude.cosine, latitude.cosine * longitude.sine,
                  latitude.sine};

  double heading = std::atan2(dot(forward, east), dot(forward, north)) * kRadian;
  if (heading < 0.0) heading += 360.0;
  return Attitude{heading, std::asin(std::clamp(dot(forward, up), -1.0, 1.0)) * kRadian,
                  std::atan2(-dot(right, up), -dot(down, up)) * kRadian};
}

}  // namespace reckon::pdu

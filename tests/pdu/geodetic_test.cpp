// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Latitude, longitude and height against the closed form of the inverse; heading, pitch and roll
// against simple attitudes.
#include "reckon/pdu/geodetic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace reckon::pdu {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// The closed form (WGS84).
WorldCoordinates geocentric(double latitude_deg, double longitude_deg, double height) {
  constexpr double kSemiMajor = 6378137.0;
  constexpr double kFlattening = 1.0 / 298.257223563;
  constexpr double kE2 = kFlattening * (2.0 - kFlattening);
  const double sine = std::sin(latitude_deg * kDegree);
  const double cosine = std::cos(latitude_deg * kDegree);
  const double normal = kSemiMajor / std::sqrt(1.0 - kE2 * sine * sine);
  return {(normal + height) * cosine * std::cos(longitude_deg * kDegree),
          (normal + height) * cosine * std::sin(longitude_deg * kDegree),
          (normal * (1.0 - kE2) + height) * sine};
}

TEST(Geodetic, InvertsTheClosedForm) {
  double worst_deg = 0.0;
  double worst_m = 0.0;
  for (double latitude = -90.0; latitude <= 90.0; latitude += 2.5) {
    for (double longitude = -179.0; longitude <= 180.0; longitude += 13.0) {
      for (const double height : {-11000.0, 0.0, 8848.0, 4e5, 1e7}) {
        const auto place = geodetic_from(geocentric(latitude, longitude, height));
        ASSERT_TRUE(place.has_value());
        worst_deg = std::max(worst_deg, std::abs(place->latitude_deg - latitude));
        worst_m = std::max(worst_m, std::abs(place->height - height));
        if (std::abs(latitude) < 90.0) {
          worst_deg = std::max(worst_deg, std::abs(place->longitude_deg - longitude));
        }
      }
    }
  }
  RecordProperty("worst_deg", std::to_string(worst_deg));
  RecordProperty("worst_m", std::to_string(worst_m));
  EXPECT_LT(worst_deg, 1e-9);  // 0.1 mm on the ground
  EXPECT_LT(worst_m, 1e-6);
}

TEST(Geodetic, RefusesLocationsThatAreNotOnEarth) {
  EXPECT_FALSE(geodetic_from({}).has_value());
  EXPECT_FALSE(geodetic_from({1000, 2000, 30}).has_value());
  EXPECT_FALSE(geodetic_from({std::numeric_limits<double>::quiet_NaN(), 7e6, 0}).has_value());
  EXPECT_FALSE(geodetic_from({std::numeric_limits<double>::infinity(), 0, 0}).has_value());
}

/// A level body that heads north at latitude 0 and longitude 0, body axes in W: x is W's z, y is
/// W's y (east), z (down) is W's -x.
TEST(Attitude, OfALevelBodyIsItsHeading) {
  const Geodetic equator{0, 0, 0};
  // theta = -90 degrees turns x along W's z, which is north there.
  const auto north = attitude_from({0.0F, static_cast<float>(-90 * kDegree), 0.0F}, equator);
  ASSERT_TRUE(north.has_value());
  EXPECT_NEAR(std::remainder(north->heading_deg, 360.0), 0.0, 1e-4);
  EXPECT_NEAR(north->pitch_deg, 0.0, 1e-4);

  // psi = 90 degrees, x east; phi = -90 degrees turns z to W's -x, which is down there.
  const auto east = attitude_from(
      {static_cast<float>(90 * kDegree), 0.0F, static_cast<float>(-90 * kDegree)}, equator);
  ASSERT_TRUE(east.has_value());
  EXPECT_NEAR(east->heading_deg, 90.0, 1e-4);
  EXPECT_NEAR(east->pitch_deg, 0.0, 1e-4);
  EXPECT_NEAR(east->roll_deg, 0.0, 1e-4);

  // 10 more degrees of phi lower the right side.
  const auto rolled = attitude_from(
      {static_cast<float>(90 * kDegree), 0.0F, static_cast<float>(-80 * kDegree)}, equator);
  ASSERT_TRUE(rolled.has_value());
  EXPECT_NEAR(rolled->roll_deg, 10.0, 1e-4);
}

TEST(Attitude, PitchIsPositiveWithTheNoseUp) {
  const auto up = attitude_from({}, Geodetic{0, 0, 0});  // x along W's x
  ASSERT_TRUE(up.has_value());
  EXPECT_NEAR(up->pitch_deg, 90.0, 1e-4);
  const auto down = attitude_from({}, Geodetic{0, 180, 0});
  ASSERT_TRUE(down.has_value());
  EXPECT_NEAR(down->pitch_deg, -90.0, 1e-4);
}

TEST(Attitude, IsEmptyForAnglesThatAreNotFinite) {
  EXPECT_FALSE(attitude_from({std::numeric_limits<float>::quiet_NaN(), 0, 0}, {}).has_value());
}

}  // namespace
}  // namespace reckon::pdu

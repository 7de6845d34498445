// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The two readings of the acceleration of RVB, where states are converted from and to the wire.
#include <gtest/gtest.h>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Vector3d;
using Error = ConversionError;
using test::Random;

const LocalFrame& monterey() {
  static const LocalFrame frame(0.6388, -2.1276, 20);
  return frame;
}

TEST(AccelerationReading, AppliesBothReadingsToRvb) {
  // extrapolate() with a given reading is the reference for an inertial sender's PDU.
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    KinematicState sent = random.state(Algorithm::rvb, 1);
    pdu::EntityState pdu;
    ASSERT_EQ(to_wire(sent, monterey(), pdu), Error::none);
    KinematicState as_sent, got;
    ASSERT_EQ(from_wire(pdu, monterey(), as_sent), Error::none);
    ASSERT_EQ(from_wire(pdu, monterey(), got, AccelerationReading::inertial), Error::none);
    const Vector3d there = extrapolate(as_sent, 2, AccelerationReading::inertial).position;
    EXPECT_LE((extrapolate(got, 2).position - there).norm(), 1e-9);
    KinematicState in_world;
    ASSERT_EQ(from_wire(pdu, in_world, AccelerationReading::inertial), Error::none);
    EXPECT_LE((in_world.acceleration - got.acceleration).norm(), 1e-12);
  }
}

TEST(AccelerationReading, RoundTripsInEitherReadingForEveryModel) {
  Random random(13);
  for (int code = 0; code <= 9; ++code) {
    const auto algorithm = static_cast<Algorithm>(code);
    for (int i = 0; i < 100; ++i) {
      const KinematicState sent = random.state(algorithm, 1);
      pdu::EntityState component, inertial;
      ASSERT_EQ(to_wire(sent, monterey(), component), Error::none);
      ASSERT_EQ(to_wire(sent, monterey(), inertial, AccelerationReading::inertial), Error::none);
      const auto& a = component.dead_reckoning.linear_acceleration;
      const auto& b = inertial.dead_reckoning.linear_acceleration;
      EXPECT_EQ(a.x != b.x || a.y != b.y || a.z != b.z, algorithm == Algorithm::rvb);

      KinematicState got;
      ASSERT_EQ(from_wire(inertial, monterey(), got, AccelerationReading::inertial), Error::none);
      EXPECT_LE((got.acceleration - sent.acceleration).norm(), 3e-5);  // float32 of a + w x V
      EXPECT_LE((got.velocity - sent.velocity).norm(), 3e-5);
    }
  }
}

TEST(AccelerationReading, RefusesAnAccelerationImpossibleInTheOtherReading) {
  KinematicState turn;
  turn.algorithm = Algorithm::rvb;
  turn.velocity = {9e5, 0, 0};
  turn.angular_velocity = {0, 0, 9e4};  // each within its limit, but w x V is 8e10 m/s^2
  pdu::EntityState pdu;
  EXPECT_EQ(to_wire(turn, monterey(), pdu, AccelerationReading::inertial), Error::speed_range);
  ASSERT_EQ(to_wire(turn, monterey(), pdu), Error::none);
  KinematicState out;
  EXPECT_EQ(from_wire(pdu, monterey(), out), Error::none);
  EXPECT_EQ(from_wire(pdu, monterey(), out, AccelerationReading::inertial), Error::speed_range);
}

}  // namespace
}  // namespace reckon::deadreckon

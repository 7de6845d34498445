// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The driver of a Polhem by the octets of its reports.
#include "reckon/haptics/polhem/polhem_driver.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <span>

#include "reckon/tests/haptics/support/polhem_model.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics::polhem_driver_test {
namespace {

using Eigen::Vector3d;
using test::PolhemModel;

// Octets of an exchange, from the start pose on.
TEST(PolhemDriver, AllocatesNothingOnceItIsSetUp) {
  PolhemDriver driver({0.1, 0.05});
  std::array<std::uint8_t, 14> octets{0, 0, 0, 0, 0x78, 0xEC};
  const UsbForce force{Vector3d(1, 2, 3)};
  UsbReading reading;
  const auto exchange = [&](std::uint8_t info, const UsbForce* shown) {
    octets[12] = info;
    std::span<const std::uint8_t> transfer(octets);
    EXPECT_TRUE(driver.read(transfer));
    const UsbStage stage = driver.judge(true, reading);
    static_cast<void>(driver.command(stage, shown));
    return stage;
  };
  const test::AllocationGuard guard;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(exchange(1, nullptr), UsbStage::homing);
  for (int i = 0; i < 1'000; ++i) {
    octets[0] = static_cast<std::uint8_t>(i % 50);
    EXPECT_EQ(exchange(0, &force), UsbStage::running);
  }
  driver.lost(true);
  EXPECT_EQ(exchange(0, nullptr), UsbStage::homing);
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_LT((reading.position - PolhemModel::start()).norm(), 5e-3);
}

TEST(PolhemDriver, ReducesAForceWithUnpaidTorques) {
  PolhemDriver driver;
  std::array<std::uint8_t, 14> octets{0, 0, 0, 0, 0x78, 0xEC};
  UsbReading reading;
  UsbStage stage = UsbStage::silent;
  for (const int info : {1, 1, 0, 0}) {
    octets[12] = static_cast<std::uint8_t>(info);
    std::span<const std::uint8_t> transfer(octets);
    ASSERT_TRUE(driver.read(transfer));
    stage = driver.judge(false, reading);
    static_cast<void>(driver.command(stage, nullptr));
  }
  ASSERT_EQ(stage, UsbStage::running);
  EXPECT_NEAR(reading.lever, 0.174, 1e-6) << "of its upper link, square to the fore one";
  const auto asked = [&](const UsbForce& force) {
    const auto told = driver.command(stage, &force);
    Vector3d currents;
    for (std::size_t i = 0; i < 3; ++i)
      currents[static_cast<Eigen::Index>(i)] =
          1e-3 * static_cast<std::int16_t>(told[2 * i] | told[2 * i + 1] << 8);
    return polhem_torques_of(polhem_1(), currents);
  };
  UsbForce force{Vector3d(1, 2, 3)};
  const Vector3d whole = asked(force);
  EXPECT_EQ(driver.share(), 1.0);
  force.lever = 0.05;
  const Vector3d part = asked(force);
  EXPECT_NEAR(part.norm(), 0.05 * force.force.norm(), 2e-3) << "of whole milliamperes";
  EXPECT_NEAR((part - driver.share() * whole).norm(), 0.0, 2e-3) << "direction kept";
  force.lever = std::numeric_limits<double>::infinity();
  force.force *= 100;  // more than its motors can give
  const Vector3d most = asked(force);
  EXPECT_NEAR((most - 100 * driver.share() * whole).norm(), 0.0, 0.1);
  EXPECT_LT(driver.share(), 0.1);
}

}  // namespace
}  // namespace reckon::haptics::polhem_driver_test

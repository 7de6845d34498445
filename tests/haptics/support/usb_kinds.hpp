// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The kinds of devices on USB for typed tests, each with five chains.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <chrono>
#include <memory>
#include <string>
#include <type_traits>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/falcon/falcon_kinematics.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/usb/usb_torques.hpp"
#include "reckon/tests/haptics/support/falcon_model.hpp"
#include "reckon/tests/haptics/support/polhem_model.hpp"

namespace reckon::test {

inline constexpr int kUsbDelays = 5;

template <class Model>
using OptionsOf =
    std::conditional_t<std::is_same_v<Model, FalconModel>, FalconModelOptions, PolhemModelOptions>;

struct FalconKind {
  using Model = FalconModel;
  // Its chip's timer fires at another time of a frame, and the declared delay is longer than the
  // true one.
  static FalconModelOptions options(int delay) {
    FalconModelOptions options;
    options.tick_at = 0.1 + 0.2 * delay;
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::FalconDriver>(haptics::FalconFirmware{});
  }
  static const haptics::UsbFacts& facts() { return haptics::falcon_facts(); }
  static constexpr double kLongest = 4.2;  ///< greatest lever(), relative to the middle
  /// See haptics::levers_of [m/rad]; 0 where its driver shows no force. @param place [m, frame D]
  static double lever(const Eigen::Vector3d& place) {
    const Eigen::Vector3d own =
        haptics::falcon_axes(place) + Eigen::Vector3d(0, 0, haptics::FalconGeometry::kMiddle);
    const auto angles = haptics::falcon_angles(own);
    const auto pose = angles ? haptics::falcon_pose(*angles) : std::nullopt;
    const bool is_there = pose && (pose->position - own).norm() < 1e-6;
    return is_there && pose->jacobian.norm() < 0.3 ? haptics::levers_of(pose->jacobian)[2] : 0;
  }
};

struct PolhemKind {
  using Model = PolhemModel;
  // Its requests and commands are at other times of a frame.
  static PolhemModelOptions options(int delay) {
    PolhemModelOptions options;
    options.in_at = 0.2 * delay;
    options.out_at = 0.15 * (4 - delay);
    return options;
  }
  static std::unique_ptr<haptics::UsbDriver> driver() {
    return std::make_unique<haptics::PolhemDriver>();
  }
  static const haptics::UsbFacts& facts() { return haptics::polhem_facts(); }
  static constexpr double kLongest = 1.45;
  static double lever(const Eigen::Vector3d& place) {
    const haptics::PolhemArm& arm = haptics::polhem_1();
    const auto angles = haptics::polhem_angles(arm, haptics::device_to_polhem(place) + arm.middle);
    const auto pose = angles ? haptics::polhem_pose(arm, *angles) : std::nullopt;
    if (!pose) return 0;
    const Eigen::Vector3d levers = haptics::levers_of(pose->jacobian);
    return levers[0] > haptics::kPolhemLeastLever ? levers[2] : 0;
  }
};

/// Length of the chain as declared to the servo.
inline std::chrono::milliseconds usb_chain(int delay) {
  return std::chrono::milliseconds(6 + 2 * delay);
}

using UsbKinds = testing::Types<FalconKind, PolhemKind>;
struct UsbKindNames {
  template <class Kind>
  static std::string GetName(int) {
    return Kind::facts().name;
  }
};

}  // namespace reckon::test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a Polhem needs that other devices on USB do not: its reports, the width of its counters, its
// start pose, its geometry and the weight of its links.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "reckon/haptics/polhem/polhem_kinematics.hpp"
#include "reckon/haptics/polhem/polhem_packets.hpp"
#include "reckon/haptics/usb/usb_driver.hpp"

namespace reckon::haptics {

/// What is known of every first Polhem: 5 N, by its makers' library; 0.2 N s/m are assumed, nine
/// tenths of which the servo gets.
[[nodiscard]] const UsbFacts& polhem_facts() noexcept;

/// Least way of the handle for a turn of the joints, in its worst direction [m/rad]: nearer to a
/// singular pose there is no force.
inline constexpr double kPolhemLeastLever = 0.05;

/// Damping [N s/m] that holding the links up may cost. The torques that do are those of where the
/// links will be in the middle of an exchange; where that is wrong by one, they make no more energy
/// than this much damping takes.
[[nodiscard]] double polhem_spent_damping(const PolhemWeights& weights) noexcept;
/// The same about the joints [N m s/rad].
[[nodiscard]] double polhem_spent_joint_damping(const PolhemWeights& weights) noexcept;

/// One Polhem, with reports of 14 octets. Its exchange takes 2 ms: a command is there with the next
/// USB frame, and the report that answers it with the one after.
///
/// It tells counts of 16 bits, which come round: ways of less than half of that between reports
/// join. What they count from is unknown until its button is pressed in its start pose.
class PolhemDriver final : public UsbDriver {
 public:
  /// @param weights that its motors hold up while forces are shown, and more and more within the
  /// first half second; >= 0
  /// @throws std::invalid_argument for other weights
  explicit PolhemDriver(const PolhemWeights& weights = {});

  [[nodiscard]] const UsbFacts& facts() const noexcept override { return polhem_facts(); }
  [[nodiscard]] const char* how_to_home() const noexcept override;
  [[nodiscard]] std::optional<UsbPipes> pipes(libusb_device_handle* handle) const override;
  [[nodiscard]] std::string set_up(UsbSetUp& desk) override;

  void lost(bool is_unplugged) noexcept override;
  void restart() noexcept override {}
  [[nodiscard]] bool read(std::span<const std::uint8_t>& transfer) noexcept override;
  [[nodiscard]] UsbStage judge(bool follows, UsbReading& reading) noexcept override;
  [[nodiscard]] std::span<const std::uint8_t> command(UsbStage stage,
                                                      const UsbForce* force) noexcept override;
  [[nodiscard]] double share() const noexcept override { return share_; }
  [[nodiscard]] std::uint64_t malformed() const noexcept override { return malformed_; }

 private:
  [[nodiscard]] bool is_homed() noexcept;
  [[nodiscard]] bool bears(const PolhemPose& pose, const Eigen::Vector3d& angles) const noexcept;
  [[nodiscard]] std::array<std::int16_t, 3> currents(const UsbForce& force) noexcept;

  PolhemWeights weights_;
  PolhemReport report_;
  std::uint64_t malformed_ = 0;
  std::array<std::uint8_t, 14> octets_{};
  double held_up_ = 0;        // share of the weights
  bool asks_ = false;         // to be homed, in its last report
  bool sets_counts_ = false;  // with the next command
  bool has_set_ = false;      // and a report without the request shows that it was obeyed
  bool homed_ = false;
  std::array<std::int32_t, 3> counts_{};              // of the last report, beyond 16 bits
  Eigen::Vector3d angles_ = Eigen::Vector3d::Zero();  // [rad], of the last report
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();    // [rad], since the one before
  Eigen::Matrix3d jacobian_ = Eigen::Matrix3d::Zero();
  double share_ = 1.0;  // of the last force
};

}  // namespace reckon::haptics

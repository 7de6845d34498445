// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Driver of a Polhem: its reports, the width of its counters, its start pose, its geometry and the
// weight of its links.
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

/// Facts of the first Polhem: 5 N, from its makers' library; an assumed damping of 0.2 N s/m, nine
/// tenths of it for the servo.
[[nodiscard]] const UsbFacts& polhem_facts() noexcept;

/// Least motion of the handle per turn of the joints, in its worst direction [m/rad]. Nearer to a
/// singular pose there is no force.
inline constexpr double kPolhemLeastLever = 0.05;

/// Damping [N s/m] that the compensation of the weights may cost. Its torques are computed for the
/// predicted pose at the middle of an exchange. If the prediction is wrong by one exchange, they
/// add no more energy than this damping dissipates.
[[nodiscard]] double polhem_spent_damping(const PolhemWeights& weights) noexcept;
/// The same per joint [N m s/rad].
[[nodiscard]] double polhem_spent_joint_damping(const PolhemWeights& weights) noexcept;

/// Driver of a Polhem with reports of 14 octets. Its exchange takes 2 ms: a command arrives with
/// the next USB frame, and the report that answers it with the one after.
///
/// Its counts have 16 bits and wrap around: motions of less than half that range between reports
/// are tracked. Their reference is unknown until the user presses its button in the start pose.
class PolhemDriver final : public UsbDriver {
 public:
  /// @param weights >= 0, which its motors compensate while it renders forces; the compensation
  /// ramps up over the first half second
  /// @throws std::invalid_argument if a weight is negative or no number
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
  double held_up_ = 0;        // share of the weights that is compensated
  bool asks_ = false;         // the last report requests homing
  bool sets_counts_ = false;  // the next command sets the counts
  bool has_set_ = false;  // a command has set the counts; a report without the request confirms it
  bool homed_ = false;
  std::array<std::int32_t, 3> counts_{};              // of the last report, extended beyond 16 bits
  Eigen::Vector3d angles_ = Eigen::Vector3d::Zero();  // [rad], of the last report
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();    // [rad], since the report before
  Eigen::Matrix3d jacobian_ = Eigen::Matrix3d::Zero();
  double share_ = 1.0;  // of the last force that was commanded
};

}  // namespace reckon::haptics

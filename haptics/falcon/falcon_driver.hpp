// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Driver of a Novint Falcon: set-up of its FTDI chip, upload of its firmware, its packets and its
// geometry.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/falcon/falcon_packets.hpp"
#include "reckon/haptics/usb/usb_driver.hpp"

namespace reckon::haptics {

/// Facts of every Falcon: 8.9 N, from its maker; an assumed damping of 0.3 N s/m, nine tenths of it
/// for the servo.
[[nodiscard]] const UsbFacts& falcon_facts() noexcept;

/// The firmware of a Falcon. It belongs to the maker and is not part of Reckon. The device loses it
/// without power.
struct FalconFirmware {
  static constexpr std::size_t kLeast = 1'000;   ///< octets
  static constexpr std::size_t kMost = 262'144;  ///< octets

  std::vector<std::uint8_t> octets;

  /// @throws std::runtime_error if the file cannot be read or its size is out of range; the text
  /// has the file and the remedy. No checksum is known, so the upload compares the device's echo.
  [[nodiscard]] static FalconFirmware load(const std::string& file);
};

/// Driver of a Falcon. Its exchange takes 2 ms: a command waits for the next USB frame, and the
/// FTDI chip holds the report until its latency timer of 1 ms expires.
class FalconDriver final : public UsbDriver {
 public:
  /// @param firmware empty: no upload; the device must already run it
  explicit FalconDriver(FalconFirmware firmware);

  [[nodiscard]] const UsbFacts& facts() const noexcept override { return falcon_facts(); }
  [[nodiscard]] const char* how_to_home() const noexcept override;
  [[nodiscard]] std::optional<UsbPipes> pipes(libusb_device_handle* handle) const override;
  [[nodiscard]] std::string set_up(UsbSetUp& desk) override;

  void lost(bool is_unplugged) noexcept override;
  void restart() noexcept override { parser_.restart(); }
  [[nodiscard]] bool read(std::span<const std::uint8_t>& transfer) noexcept override;
  [[nodiscard]] UsbStage judge(bool follows, UsbReading& reading) noexcept override;
  [[nodiscard]] std::span<const std::uint8_t> command(UsbStage stage,
                                                      const UsbForce* force) noexcept override;
  [[nodiscard]] double share() const noexcept override { return share_; }
  [[nodiscard]] std::uint64_t malformed() const noexcept override { return parser_.malformed(); }

 private:
  [[nodiscard]] bool answers(UsbSetUp& desk);
  [[nodiscard]] std::string load_firmware(UsbSetUp& desk);
  [[nodiscard]] std::array<std::int16_t, 3> motors(const UsbForce& force) noexcept;

  FalconFirmware firmware_;
  FalconReportParser parser_;
  FalconReport report_;
  std::array<std::uint8_t, kFalconPacket> octets_{};
  Eigen::Vector3d angles_ = Eigen::Vector3d::Zero();  // [rad], of the last report
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();    // [rad], since the report before
  Eigen::Matrix3d jacobian_ = Eigen::Matrix3d::Zero();
  double share_ = 1.0;  // of the last force that was commanded
};

}  // namespace reckon::haptics

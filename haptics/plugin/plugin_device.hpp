// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device whose driver is a shared library; see device_plugin.h.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/plugin/device_plugin.h"

namespace reckon::haptics {

/// Checks all values from the driver: a reading fails if a number is not finite or the orientation
/// is no unit quaternion. A driver that blocks the servo is reported. A driver can corrupt the
/// memory of the program, which cannot be checked: load only drivers that you trust.
class PluginDevice final : public HapticDevice {
 public:
  /// Loads a driver and opens its device. @param options for the driver, in its own format
  /// @throws std::runtime_error with the file, the fault and the remedy: no such file, no driver,
  /// another version of the interface, a device that does not open or has impossible limits
  PluginDevice(const std::filesystem::path& file, const std::string& options);
  ~PluginDevice() override;
  PluginDevice(const PluginDevice&) = delete;
  PluginDevice& operator=(const PluginDevice&) = delete;

  [[nodiscard]] DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] DeviceSample read(std::chrono::nanoseconds now) noexcept override;
  void write(const Eigen::Vector3d& force, std::chrono::nanoseconds now) noexcept override {
    write_wrench(force, Eigen::Vector3d::Zero(), now);
  }
  void write_wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& torque,
                    std::chrono::nanoseconds now) noexcept override;

  /// Name of the driver.
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Notices for the user since the last call: a slow driver, invalid readings. From any one
  /// thread.
  [[nodiscard]] std::vector<std::string> take_notices();

  /// A driver is reported as slow if ten calls, and one in a hundred, have taken longer. The
  /// threshold allows for calls that the host interrupts.
  static constexpr std::chrono::microseconds kSlow{200};

 private:
  struct Library;

  void note_time(std::chrono::steady_clock::time_point begun) noexcept;

  std::unique_ptr<Library> library_;
  const reckon_device_driver* driver_ = nullptr;
  void* device_ = nullptr;
  DeviceLimits limits_;
  std::string name_;
  std::atomic<std::uint64_t> calls_{0}, slow_{0};
  std::atomic<std::int64_t> slowest_{0};  // [ns]
  std::atomic<std::uint64_t> impossible_{0};
  bool told_slow_ = false;
  std::uint64_t told_impossible_ = 0;
};

}  // namespace reckon::haptics

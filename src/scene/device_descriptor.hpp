// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Properties of a device, in a file of its own.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/peer/drivers/device_config.hpp"
#include "reckon/peer/scene/scene_keys.hpp"

namespace reckon::peer {

/// USB vendor and product IDs of a device.
struct UsbId {
  std::uint16_t vendor = 0, product = 0;
  friend constexpr bool operator==(const UsbId&, const UsbId&) = default;
};

/// The work space of a device [m], frame D.
struct WorkSpaceCorners {
  Eigen::Vector3d from = Eigen::Vector3d::Constant(-0.05);
  Eigen::Vector3d to = Eigen::Vector3d::Constant(0.05);
};

/// A file of devices/. docs/devices.md lists its keys.
struct DeviceDescriptor : DeviceAbility {
  DeviceDescriptor() { damping = 0.0; }
  std::string name;        ///< product name
  std::vector<UsbId> usb;  ///< USB IDs of the device; none: not on USB
  haptics::DeviceKind kind = haptics::DeviceKind::impedance;
  std::chrono::nanoseconds delay{0};  ///< until a force reaches the handle
  double mass = 0.1;                  ///< [kg]
  double friction = 0.0;              ///< [N], dry
  WorkSpaceCorners work_space;        ///< [m]
  double inertia = 1e-4;              ///< [kg m^2], for 6 axes
};

/// @param file for messages @throws SceneFileError with the place and the remedy of each bad key
[[nodiscard]] DeviceDescriptor parse_device_descriptor(std::string_view text,
                                                       const std::string& file);
/// @throws as above
[[nodiscard]] DeviceDescriptor load_device_descriptor(const std::filesystem::path& file);

/// Folders for descriptors without a folder: relative to the installed program, the installation
/// folder of Reckon, the source folder.
[[nodiscard]] std::vector<std::filesystem::path> device_folders();
/// "falcon", "falcon.toml" or "folder/mine.toml": a file relative to `folder`, else in one of
/// device_folders(). @throws std::invalid_argument with the searched places
[[nodiscard]] std::filesystem::path find_device_descriptor(const std::string& name,
                                                           const std::filesystem::path& folder);

/// THE list of its keys; and the same as the table of docs/devices.md.
[[nodiscard]] const std::vector<SceneKey>& device_descriptor_keys();
[[nodiscard]] std::string device_descriptor_markdown();

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A driver of real devices: all that a scene, a command and a peer need of it, as one row. The rows
// are in drivers.cpp. A driver is a file here that defines its row, a line in drivers.cpp and a
// line in CMakeLists.txt.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "reckon/haptics/usb/usb_driver.hpp"
#include "reckon/haptics/usb/usb_limits.hpp"
#include "reckon/haptics/usb/usb_session.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/drivers/device_config.hpp"

namespace reckon::peer {

class RealDevice;

/// A key of [[device]] that one driver has.
struct DriverKey {
  std::string_view key;
  DriverValue standard;  ///< the default; a value in the file has the same type
  std::string_view unit = {};
  double least = 0, most = 0;  ///< [unit], inclusive, of a number
  bool has_default = true;     ///< false: the key states a measured value
  std::string_view help = {};
  std::string_view flag = {};       ///< of demo, peer and measure, for the same value; empty: none
  std::string_view flag_help = {};  ///< if there is a flag
  /// @throws std::runtime_error if the file of the flag cannot be used
  void (*check_file)(const std::string& file) = nullptr;
};

/// How --device names a device of this driver by where it is, instead of by the driver.
struct DevicePlace {
  std::string_view help;                ///< "the line of a serial board (/dev/ttyACM0)"
  bool (*is)(const std::string& text);  ///< whether the text is such a place
  void (*put)(DeviceConfig& device, const std::string& text);  ///< @throws std::invalid_argument
};

/// Damping of a device that its driver uses itself.
struct SpentDamping {
  double handle = 0.0;  ///< [N s/m]
  double joints = 0.0;  ///< [N m s/rad]
};

/// A device whose force is written each period and that reports its position.
struct ForceSide {
  const haptics::UsbFacts& (*facts)() noexcept;
  std::chrono::microseconds silence = haptics::UsbSession::kSilence;  ///< then it is let go
  /// [N], > 0: its maker alone knows the force, step and place, and the file states them; this
  /// force is assumed until then. 0: the driver knows them.
  double assumed_force = 0.0;
  SpentDamping (*spent)(const DeviceConfig& device) = nullptr;  ///< null: none
  /// The port that it is on; null: it is found by its USB IDs, one device to a program.
  const std::string& (*line)(const DeviceConfig& device) = nullptr;
  /// Of a device that is found by its USB IDs.
  std::unique_ptr<haptics::UsbDriver> (*make)(const DeviceConfig& device) = nullptr;
  std::string_view product = {};  ///< of such a device: its name for the user
  std::string_view use = {};      ///< what it can do
};

/// A device that takes the parameters of springs and renders them by itself.
struct SpringSide {
  /// The device as a servo sees it, with its limits; opens nothing. @throws std::invalid_argument
  std::shared_ptr<haptics::HapticDevice> (*felt)(const DeviceConfig& device);
  /// Time until a changed spring is at the handle.
  std::chrono::nanoseconds (*change)(const DeviceConfig& device);
};

/// What a driver needs to open a device.
struct DeviceOpening {
  const Clock& clock;  ///< the servo's; outlives the device
  /// The file of native code that a scene names. @throws if the user does not trust it
  std::function<std::filesystem::path(const std::filesystem::path& name)> trusted;
};

struct OpenedDevice {
  std::unique_ptr<RealDevice> device;
  std::string notice;  ///< what its servo relies on: a sentence
};

/// An attached device that a driver can use.
struct AttachedDevice {
  std::string driver;   ///< as written after --device and in [[device]]
  std::string name;     ///< product name and path of the device
  std::string use;      ///< how to use it
  std::string problem;  ///< why it cannot be used now; empty: it can
  std::string remedy;   ///< for the problem
};

/// One row. Functions that are null are not needed by this driver.
struct Driver {
  std::string_view name;     ///< in [[device]], and after --device if `is_named`
  bool is_named = true;      ///< its name alone finds a device
  std::string_view article;  ///< "a Falcon", in sentences about who has a key or holds it
  std::string_view summary;  ///< for help: "a Novint Falcon on USB"
  bool is_held = true;       ///< a person holds its devices, so that no pointer moves them
  bool is_cooled = false;    ///< its devices protect their motors themselves
  std::vector<DriverKey> keys = {};
  /// Why the device cannot have this driver, with the remedy: a sentence; empty: it can.
  std::string (*fault)(const DeviceConfig& device) = nullptr;
  /// Such a device without its values replaces a simulated one: a scene may state them already.
  bool stands_in = false;
  const ForceSide* force = nullptr;
  const SpringSide* springs = nullptr;
  const DevicePlace* place = nullptr;
  /// "a person, by a Falcon"; null: "a person, by" the article.
  std::string (*holder)(const DeviceConfig& device) = nullptr;
  /// File of the native code that it runs; null: none.
  std::filesystem::path (*native_code)(const DeviceConfig& device) = nullptr;
  /// Attached devices; null: those with the USB IDs of `force`.
  std::vector<AttachedDevice> (*find)() = nullptr;
  /// Ports of this host to which its devices may be connected; opens none. Null: it uses no ports.
  std::vector<AttachedDevice> (*ports)() = nullptr;
  /// Lines of the udev rule for this host; null: those for the USB IDs of `force`.
  std::string (*udev)() = nullptr;
  /// @throws std::runtime_error with the remedy  Null: by the USB IDs of `force`.
  OpenedDevice (*open)(const DeviceConfig& device, const DeviceOpening& opening) = nullptr;
};

/// Each driver once, in the order of messages.
[[nodiscard]] std::span<const Driver* const> drivers();
/// Null: there is none of this name.
[[nodiscard]] const Driver* find_driver(std::string_view name);
/// The name of its driver, or "simulated".
[[nodiscard]] std::string_view driver_name(const DeviceConfig& device);
/// "simulated" and the names of all drivers.
[[nodiscard]] const std::vector<std::string_view>& driver_names();
/// Ports of this host to which devices of any driver may be connected.
[[nodiscard]] std::vector<AttachedDevice> driver_ports();
/// The value of a key of a driver, or its default. `T`: as DriverKey::standard.
/// @throws std::invalid_argument if no driver has the key
[[nodiscard]] const DriverValue& driver_value(const DeviceConfig& device, std::string_view key);
template <class T>
[[nodiscard]] const T& driver_value(const DeviceConfig& device, std::string_view key) {
  return std::get<T>(driver_value(device, key));
}

/// Which values of a device were measured on the real device.
struct MeasuredFlags {
  bool damping = false;
  bool delay = false;
  bool max_force = false;
  bool resolution = false;
  /// The damping holds in every pose; false: it was measured in the middle of the work space.
  bool everywhere = false;
};

/// Sets the driver of a device, and the limits of the real device unless the file gives them.
void use_driver(DeviceConfig& device, const Driver& driver, const MeasuredFlags& measured);
/// Known facts of the real device of a driver; null: its driver writes no forces.
[[nodiscard]] const haptics::UsbFacts* usb_facts_of(const DeviceConfig& device);
/// Whether it renders springs by itself.
[[nodiscard]] bool renders_springs(const DeviceConfig& device) noexcept;
/// Settings for the driver of a real device that takes forces.
[[nodiscard]] haptics::UsbSettings usb_settings_of(const DeviceConfig& device);
/// Opens a device by its driver. @throws std::runtime_error with the remedy
[[nodiscard]] OpenedDevice open_device(const DeviceConfig& device, const DeviceOpening& opening);
/// What the servo relies on for a device with these limits: a sentence.
[[nodiscard]] std::string force_notice(const DeviceConfig& device,
                                       const haptics::DeviceLimits& limits);
/// The line of a rule of udev that opens a device for the person at this host.
[[nodiscard]] std::string udev_line(std::string_view subsystem, std::string_view attribute,
                                    std::uint16_t vendor, std::uint16_t product);

}  // namespace reckon::peer

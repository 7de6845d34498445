// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The real devices of a peer.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reckon/haptics/devices/mapped_device.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/threads/real_device.hpp"
#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::tools {

/// --device, the flags of drivers and --plugin of a demo or a peer.
struct DeviceChoice {
  std::string device;  ///< name of a driver, place of a device or a descriptor; empty: as in the
                       ///< scene
  std::vector<std::string> plugins = {};              ///< files of --plugin
  std::map<std::string_view, std::string> keys = {};  ///< of flags of drivers, by DriverKey::key;
                                                      ///< empty: as in the scene
};

/// Driver files that the user named by --plugin or --device.
[[nodiscard]] std::vector<std::string> plugins_of(const DeviceChoice& choice);

/// The driver of a --device that passed check_device_choice().
[[nodiscard]] const peer::Driver& driver_of(const std::string& device);

/// The flags of drivers. @param prefix of their help
void add_driver_flags(CommandLine& line, DeviceChoice& choice, std::string_view prefix = "");
void add_device_flags(CommandLine& line, DeviceChoice& choice);

/// The flags of drivers that the user gave.
[[nodiscard]] std::vector<std::string_view> driver_flags_of(const DeviceChoice& choice);

/// @throws UsageError for an unknown driver, with the nearest word, and for a file of a flag that
/// its driver cannot use
void check_device_choice(const DeviceChoice& choice);

/// Sets the chosen driver, if any, for the first device of peer `number`. Real devices of that peer
/// without a position in the scene are placed at the start of their operators: within reach of the
/// objects, and not inside of one. @throws UsageError for a peer without a device, and for a flag
/// of a driver without a device that has it
void choose_device(const DeviceChoice& choice, peer::SceneFile& scene, std::uint32_t number,
                   std::size_t peers);

/// Owns the real devices of a process; outlives the peers that use them.
class RealDevices {
 public:
  /// @param plugins driver files that may be loaded in addition to the ones in native_code_folder()
  explicit RealDevices(std::vector<std::string> plugins = {}) : trusted_(std::move(plugins)) {}

  /// Replaces the simulated devices of peer `number` that have a driver by real ones.
  /// @param wired from make_simulated_hands() for that peer
  /// @throws std::runtime_error with the remedy if a plugin is refused, the host has no USB, a
  /// firmware cannot be read, or a second device of a kind, or on a serial port, is requested
  /// @throws UsageError for a plugin that is not trusted
  void plug_in(const peer::SceneFile& scene, std::uint32_t number,
               std::vector<peer::PeerDevice>& wired);
  /// Notices since the last call.
  [[nodiscard]] std::vector<std::string> take_notices();
  /// Axes of frame D of the first device, bit 0 for x. A serial board reports them once it is
  /// ready; until then, and for other devices, all three.
  [[nodiscard]] unsigned axes() const noexcept;
  /// The first device, if it sends reports asynchronously; else null.
  [[nodiscard]] const haptics::UsbDevice* reports() const noexcept;

 private:
  struct Driven {
    const peer::Driver* driver;
    std::string line;  // of a device on a line
    std::unique_ptr<peer::RealDevice> real;
  };

  /// @throws std::runtime_error if another device of this process already uses its place
  void check_free(const peer::DeviceConfig& config) const;
  /// The device, with the mapping from handle to hand if there is one.
  [[nodiscard]] haptics::HapticDevice* as_mapped(haptics::HapticDevice& device,
                                                 const peer::DeviceConfig& config);

  std::vector<std::string> trusted_;
  peer::SteadyClock clock_;
  std::vector<std::unique_ptr<haptics::MappedDevice>> mapped_;  // before the real ones
  std::vector<Driven> driven_;
  std::vector<std::string> sentences_;
};

}  // namespace reckon::tools

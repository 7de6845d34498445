// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The real devices of a peer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/devices/mapped_device.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/threads/real_device.hpp"
#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::tools {

/// --device, --firmware and --plugin of a demo or a peer.
struct DeviceChoice {
  std::string device;    ///< name or file of a driver, serial port with @BAUD if not the
                         ///< default, or path of an event device; empty: as in the scene
  std::string firmware;  ///< file; empty: as in the scene
  std::vector<std::string> plugins = {};  ///< files of --plugin
};

/// Driver files that the user named by --plugin or --device.
[[nodiscard]] std::vector<std::string> plugins_of(const DeviceChoice& choice);

/// Whether a --device is the path of a device that renders springs by itself.
[[nodiscard]] bool is_event_device(const std::string& device);

void add_device_flags(CommandLine& line, DeviceChoice& choice);

/// @throws UsageError for an unknown driver, with the nearest word, and for a file that is no
/// firmware
void check_device_choice(const DeviceChoice& choice);

/// Sets the chosen driver, if any, for the first device of peer `number`. Real devices of that peer
/// without a position in the scene are placed at the start of their operators: within reach of the
/// objects, and not inside of one. @throws UsageError for a peer without a device, and for
/// --firmware without a device that takes it
void choose_device(const DeviceChoice& choice, peer::SceneFile& scene, std::uint32_t number,
                   std::size_t peers);

/// Owns the real devices of a process; outlives the peers that use them.
class RealDevices {
 public:
  /// @param plugins driver files that may be loaded in addition to the ones in plugin_folder()
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
    peer::DeviceDriver driver;
    std::string port;  // of a serial board
    std::unique_ptr<peer::RealDevice> real;
  };

  /// Opens a device and adds its notice to sentences_.
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open(const peer::DeviceConfig& config);
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open_plugin(const peer::DeviceConfig& config);
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open_evdev(const peer::DeviceConfig& config);
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open_by_forces(const peer::DeviceConfig& config);
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

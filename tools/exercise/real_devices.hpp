// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The devices of a peer that are no simulation.
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
  std::string device;    ///< name of a driver, file of one, line of a board, with @BAUD where it
                         ///< is not the usual, or path of a wheel; empty: as the scene says
  std::string firmware;  ///< file; empty: as the scene says
  std::vector<std::string> plugins = {};  ///< files of --plugin
};

/// Files of drivers that the user named, by --plugin or --device.
[[nodiscard]] std::vector<std::string> plugins_of(const DeviceChoice& choice);

/// Whether a --device is the path of one that renders springs by itself.
[[nodiscard]] bool is_event_device(const std::string& device);

void add_device_flags(CommandLine& line, DeviceChoice& choice);

/// @throws UsageError for a driver that does not exist, with the nearest word, and for a file that
/// is no firmware
void check_device_choice(const DeviceChoice& choice);

/// The first device of peer `number` gets the driver that is chosen, if any is. Real devices of
/// that peer which the scene puts nowhere then stand where their operators begin: in reach of what
/// there is to touch, and not inside of it. @throws UsageError for a peer without a device, and for
/// --firmware where no device would take it
void choose_device(const DeviceChoice& choice, peer::SceneFile& scene, std::uint32_t number,
                   std::size_t peers);

/// Holds the real devices of a process; outlives the peers that use them.
class RealDevices {
 public:
  /// @param plugins files of drivers that may be loaded, besides those of plugin_folder()
  explicit RealDevices(std::vector<std::string> plugins = {}) : trusted_(std::move(plugins)) {}

  /// Puts real devices in the place of the simulated ones of peer `number` that have a driver.
  /// @param wired that of make_simulated_hands() for that peer @throws std::runtime_error with the
  /// remedy where a plugin is refused, the host has no USB, a firmware cannot be read, or a second
  /// device of a kind, or on a line, is asked for, UsageError for a plugin that is not trusted
  void plug_in(const peer::SceneFile& scene, std::uint32_t number,
               std::vector<peer::PeerDevice>& wired);
  /// Sentences since the last call.
  [[nodiscard]] std::vector<std::string> take_notices();
  /// Axes of frame D that the first device has, bit 0 for x: a serial board tells once it is ready,
  /// and of all others it is all three.
  [[nodiscard]] unsigned axes() const noexcept;
  /// The first device, where it reports at times of its own; else null.
  [[nodiscard]] const haptics::UsbDevice* reports() const noexcept;

 private:
  struct Driven {
    peer::DeviceDriver driver;
    std::string port;  // of a serial board
    std::unique_ptr<peer::RealDevice> real;
  };

  /// Opens it; its sentence joins the others.
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open(const peer::DeviceConfig& config);
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open_plugin(const peer::DeviceConfig& config);
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open_evdev(const peer::DeviceConfig& config);
  [[nodiscard]] std::unique_ptr<peer::RealDevice> open_by_forces(const peer::DeviceConfig& config);
  /// @throws std::runtime_error where another device of this process is in its place
  void check_free(const peer::DeviceConfig& config) const;
  /// As the hand has it.
  [[nodiscard]] haptics::HapticDevice* as_mapped(haptics::HapticDevice& device,
                                                 const peer::DeviceConfig& config);

  std::vector<std::string> trusted_;
  peer::SteadyClock clock_;
  std::vector<std::unique_ptr<haptics::MappedDevice>> mapped_;  // before the real ones
  std::vector<Driven> driven_;
  std::vector<std::string> sentences_;
};

}  // namespace reckon::tools

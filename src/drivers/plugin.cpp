// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "reckon/haptics/plugin/plugin_device.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/threads/real_device.hpp"

namespace reckon::peer {
namespace {

std::filesystem::path library_of(const DeviceConfig& device) {
  return driver_value<std::string>(device, "plugin");
}

// The servo calls it directly; it has no thread of its own.
class LoadedPlugin final : public RealDevice {
 public:
  LoadedPlugin(const std::filesystem::path& file, const std::string& options)
      : device_(file, options) {}
  [[nodiscard]] const std::string& name() const noexcept { return device_.name(); }
  haptics::HapticDevice& device() noexcept override { return device_; }
  std::vector<std::string> take_notices() override { return device_.take_notices(); }

 private:
  haptics::PluginDevice device_;
};

OpenedDevice open_plugin(const DeviceConfig& device, const DeviceOpening& opening) {
  const std::filesystem::path file = opening.trusted(library_of(device));
  auto plugin =
      std::make_unique<LoadedPlugin>(file, driver_value<std::string>(device, "plugin_options"));
  std::string notice =
      fmt::format("{}: assumes {:.2g} N s/m of damping, as its driver states; loaded from {}",
                  plugin->name(), plugin->device().limits().damping, file.string());
  return {std::move(plugin), std::move(notice)};
}

}  // namespace

const Driver& plugin_driver() {
  static const DevicePlace kPlace{
      "the file of a driver (./DRIVER.so)",
      [](const std::string& text) {
        return !text.starts_with("/dev/") && !text.ends_with(".toml") &&
               (text.find('/') != std::string::npos || text.ends_with(".so"));
      },
      [](DeviceConfig& device, const std::string& text) {
        device.driver_values["plugin"] = std::filesystem::absolute(text).string();
      }};
  static const Driver kDriver{
      .name = "plugin",
      .is_named = false,
      .article = "a driver in a shared library",
      .summary = "your own driver in a shared library",
      .is_held = false,
      .keys = {{.key = "plugin",
                .standard = std::string(),
                .help = "of a plugin: name of the driver's shared library, installed or given by "
                        "--plugin; the driver states the limits of the device"},
               {.key = "plugin_options",
                .standard = std::string(),
                .help = "of a plugin: options for its driver"}},
      .fault =
          [](const DeviceConfig& device) {
            return std::string(library_of(device).has_filename()
                                   ? ""
                                   : "a plugin needs a shared library: add plugin = \"driver.so\"");
          },
      .place = &kPlace,
      .holder =
          [](const DeviceConfig& device) {
            return fmt::format(
                "the device of {}, whose driver states the limits at run time; these are those of "
                "a simulated device",
                library_of(device).filename().string());
          },
      .native_code = library_of,
      .open = open_plugin};
  return kDriver;
}

}  // namespace reckon::peer

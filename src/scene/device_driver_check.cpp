// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks which keys of a [[device]] its driver allows and requires.
#include <fmt/format.h>

#include <chrono>
#include <string>
#include <vector>

#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/haptics/usb/usb_session.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

/// The keys of one driver only, and its requirements.
struct DriverKeys {
  DeviceDriver driver;
  std::vector<const char*> keys;
  const char* misplaced;                            // error for another driver with these keys
  bool (*is_complete)(const DeviceConfig& device);  // null: always
  const char* incomplete;                           // error if not complete
};

const std::vector<DriverKeys>& driver_keys() {
  static const std::vector<DriverKeys> kAll{
      {DeviceDriver::falcon,
       {"firmware"},
       "only a Falcon has one: add driver = \"falcon\", or take it out",
       nullptr,
       ""},
      {DeviceDriver::plugin,
       {"plugin", "plugin_options"},
       "only a driver that is a shared library has it: add driver = \"plugin\", or take it out",
       [](const DeviceConfig& device) { return device.plugin.has_filename(); },
       "a plugin is a shared library: name it with plugin = \"driver.so\""},
      {DeviceDriver::serial,
       {"port", "baud"},
       "only a board on a serial line has it: add driver = \"serial\", or take it out",
       [](const DeviceConfig& device) { return !device.port.empty(); },
       "a board is on a serial line: name that with port = \"/dev/ttyACM0\""},
      {DeviceDriver::evdev,
       {"event", "event_axes", "travel", "full_force", "full_stiffness"},
       "only a force feedback device of Linux has it: say driver = \"evdev\", or take it out",
       nullptr,
       ""},
      {DeviceDriver::polhem,
       {"upper_weight", "fore_weight"},
       "only a Polhem has links whose weight is held up: add driver = \"polhem\", or take it out",
       nullptr,
       ""}};
  return kAll;
}

void check_keys(TomlReader& table, DeviceConfig& device) {
  std::string plugin;
  table.read("plugin", plugin);
  device.plugin = plugin;
  for (const DriverKeys& row : driver_keys()) {
    const bool is_it = device.driver == row.driver;
    // A simulated device may replace an event device.
    const bool stands_in =
        row.driver == DeviceDriver::evdev && device.driver == DeviceDriver::simulated;
    for (const char* key : row.keys)
      if (!is_it && !stands_in && table.has(key)) table.problem(key, row.misplaced);
    if (is_it && row.is_complete != nullptr && !row.is_complete(device))
      table.problem("driver", row.incomplete);
  }
}

// The user must give the scale of an event device: nothing is assumed.
void check_evdev(TomlReader& table, const DeviceConfig& device) {
  if (device.driver != DeviceDriver::evdev) return;
  if (device.source == DeviceSource::pointer)
    table.problem("kind", "a person holds an event device, and no pointer moves it: take kind out");
  if (const std::string fault = evdev_fault_of(device); !fault.empty())
    table.problem("driver", fault);
}

// The friction is given for the handle or for the joints. The table overrides a descriptor.
void check_joint_damping(TomlReader& table, DeviceConfig& device) {
  const bool has_joints =
      device.driver == DeviceDriver::falcon || device.driver == DeviceDriver::polhem;
  if (table.has("joint_damping") && !has_joints)
    table.problem("joint_damping",
                  "only the joints of a Falcon or a Polhem are known: add its driver, or say the "
                  "damping of the handle");
  if (table.has("joint_damping") && table.has("damping"))
    table.problem("joint_damping", "friction is said twice, of the handle too: keep one");
  if (table.has("damping") && !table.has("joint_damping")) device.joint_damping = 0.0;
}

}  // namespace

// Rejects values that the driver provides itself.
void check_device_driver(TomlReader& table, DeviceConfig& device) {
  check_keys(table, device);
  check_joint_damping(table, device);
  check_evdev(table, device);
  const haptics::UsbFacts* const facts = usb_facts_of(device);
  if (facts == nullptr) return;
  const std::string name = facts->name;
  if (device.source == DeviceSource::pointer)
    table.problem("kind", "a person holds a " + name + ", and no pointer moves it: take kind out");
  const bool is_serial = device.driver == DeviceDriver::serial;
  if (table.has("resolution") && !is_serial)
    table.problem("resolution", "the driver knows the steps of a " + name + ": take it out");
  const std::chrono::microseconds silence =
      is_serial ? haptics::SerialSession::kSilence : haptics::UsbSession::kSilence;
  if (5 * device.period > 2 * silence)
    table.problem("rate", fmt::format("a {} is let go after {:.3g} ms without a force, which one "
                                      "missed period must not bring about: 400 Hz is enough",
                                      name, 1e-3 * static_cast<double>(silence.count())));
  const bool described = !device.described.name.empty();
  const auto said = [&](const char* key) { return described || table.has(key); };
  use_driver(device, device.driver,
             {said("damping"), said("delay"), said("max_force"), said("resolution"),
              table.has("damping")});
  if (device.upper_weight + device.fore_weight > 0 && !(device.damping > 0)) {
    const haptics::UsbSettings settings = usb_settings_of(device);
    const bool by_joints = settings.joint_damping > 0;
    table.problem("damping",
                  fmt::format("to hold the links up costs {:.2g} {}, and none is left for walls: "
                              "state more, if you are sure of it, or less weight",
                              by_joints ? settings.spent_joint_damping : settings.spent_damping,
                              by_joints ? "N m s/rad of joint_damping" : "N s/m of damping"));
  }
}

}  // namespace reckon::peer

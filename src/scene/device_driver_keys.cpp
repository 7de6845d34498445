// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The keys of a [[device]] that its driver has, and which of them it allows and requires.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

// A simulated device may replace one whose driver allows it.
void check_keys(TomlReader& table, const DeviceConfig& device) {
  for (const Driver* driver : drivers()) {
    if (device.driver == driver || (driver->stands_in && device.driver == nullptr)) continue;
    for (const DriverKey& row : driver->keys)
      if (table.has(row.key))
        table.problem(row.key,
                      fmt::format("only {} has this key: add driver = \"{}\", or remove the key",
                                  driver->article, driver->name));
  }
  if (device.driver == nullptr || device.driver->fault == nullptr) return;
  if (const std::string fault = device.driver->fault(device); !fault.empty())
    table.problem("driver", fault);
}

// The friction is given for the handle or for the joints. The table overrides a descriptor.
void check_joint_damping(TomlReader& table, DeviceConfig& device) {
  const haptics::UsbFacts* const facts = usb_facts_of(device);
  if (table.has("joint_damping") && (facts == nullptr || !(facts->lever > 0)))
    table.problem("joint_damping",
                  "its driver does not know the joints: remove 'joint_damping', and write the "
                  "'damping' of the handle");
  if (table.has("joint_damping") && table.has("damping"))
    table.problem("joint_damping",
                  "'joint_damping' and 'damping' both give the friction: keep one");
  if (table.has("damping") && !table.has("joint_damping")) device.joint_damping = 0.0;
}

// Rejects values that a driver of forces provides itself.
void check_forces(TomlReader& table, DeviceConfig& device) {
  const ForceSide& force = *device.driver->force;
  const std::string name = force.facts().name;
  if (table.has("resolution") && !(force.assumed_force > 0))
    table.problem("resolution",
                  "the driver sets the resolution of a " + name + ": remove 'resolution'");
  if (5 * device.period > 2 * force.silence)
    table.problem("rate", fmt::format("a {} drops its force after {:.3g} ms without a command, "
                                      "which one missed period can exceed: write 400 Hz or more",
                                      name, 1e-3 * static_cast<double>(force.silence.count())));
  const bool described = !device.described.name.empty();
  const auto said = [&](const char* key) { return described || table.has(key); };
  use_driver(device, *device.driver,
             {said("damping"), said("delay"), said("max_force"), said("resolution"),
              table.has("damping")});
  const haptics::UsbSettings settings = usb_settings_of(device);
  if (settings.spent_damping > 0 && !(device.damping > 0)) {
    const bool by_joints = settings.joint_damping > 0;
    table.problem("damping",
                  fmt::format("its driver uses {:.2g} {} and leaves none for walls: raise it if it "
                              "is measured, or let the driver compensate less",
                              by_joints ? settings.spent_joint_damping : settings.spent_damping,
                              by_joints ? "N m s/rad of joint_damping" : "N s/m of damping"));
  }
}

}  // namespace

Row<DeviceConfig> driver_key_row(const DriverKey& key) {
  const Written standard =
      std::visit([&](const auto& value) { return written(value, key.unit); }, key.standard);
  SceneKey row;
  row.key = key.key;
  row.kind = standard.kind;
  row.unit = key.unit;
  row.least = key.least;
  row.most = key.most;
  if (key.has_default) row.standard = standard.text;
  row.sentence = key.help;
  return {std::move(row), [&key](TomlReader& table, DeviceConfig& out) {
            if (!table.has(key.key)) return;
            DriverValue value = key.standard;
            std::visit([&](auto& target) { table.read(key.key, target); }, value);
            out.driver_values[key.key] = std::move(value);
          }};
}

Row<DeviceConfig> driver_row() {
  std::vector<std::string> known;
  for (const Driver* driver : drivers())
    known.push_back(fmt::format("{} ({})", driver->summary, driver->name));
  SceneKey row;
  row.key = "driver";
  row.kind = KeyKind::choice;
  row.standard = driver_names().front();
  row.sentence = fmt::format(
      "simulated, or a real device that a person holds: {}. In simulated time, its operator "
      "replaces the person",
      fmt::join(known, ", "));
  row.words = driver_names();
  return {std::move(row), [](TomlReader& table, DeviceConfig& out) {
            if (const auto word = table.choice("driver")) out.driver = find_driver(*word);
          }};
}

void check_device_driver(TomlReader& table, DeviceConfig& device) {
  check_keys(table, device);
  check_joint_damping(table, device);
  if (device.driver == nullptr) return;
  if (device.source == DeviceSource::pointer && device.driver->is_held)
    table.problem("kind", fmt::format("a person moves {}, so a pointer cannot: remove 'kind'",
                                      device.driver->article));
  if (device.driver->force != nullptr) check_forces(table, device);
}

}  // namespace reckon::peer

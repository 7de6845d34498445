// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/device_descriptor.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/scene/key_row.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/scene/toml_bounds.hpp"
#include "reckon/peer/scene/toml_reader.hpp"

namespace reckon::peer {
namespace {

using haptics::DeviceKind;

std::uint16_t parse_hexadecimal(std::string_view text, std::string_view whole) {
  std::uint16_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.size() != 4 || error != std::errc() || end != text.data() + text.size())
    throw std::invalid_argument(fmt::format(
        "'{}' is not a USB ID: write vendor and product with four digits each, as \"0403:cb48\"",
        whole));
  return value;
}

UsbId parse_usb_id(std::string_view text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  return {parse_hexadecimal(text.substr(0, colon), text),
          parse_hexadecimal(text.substr(std::min(colon + 1, text.size())), text)};
}

void check_kind(TomlReader& file, const DeviceDescriptor& device) {
  if (device.kind == DeviceKind::impedance) return;
  std::vector<std::string> takers;  // of force models
  for (const Driver* driver : drivers())
    if (driver->springs != nullptr) takers.push_back(fmt::format("\"{}\"", driver->name));
  file.problem(
      "kind",
      fmt::format("a descriptor is for impedance devices only: describe a device that takes a force "
                  "model in [[device]] with driver = {}, and one that takes a motion with "
                  "virtual_mass",
                  fmt::join(takers, " or ")));
}

void check_axes(TomlReader& file, const DeviceDescriptor& device) {
  if (device.axes != 3 && device.axes != 6) {
    return file.problem("axes",
                        fmt::format("{} axes are not supported: write 6 for a device with torque, "
                                    "or 3 if three axes move the handle and the others are passive",
                                    device.axes));
  }
  const char* const turning[] = {"max_torque", "turn_damping", "turn_resolution", "inertia"};
  for (const char* key : turning) {
    if (device.axes == 6 && std::string_view(key) != "inertia") file.require(key);
    if (device.axes == 3 && file.has(key))
      file.problem(key, fmt::format("'{0}' needs axes = 6: add it, or remove '{0}'", key));
  }
}

// Required keys: a servo cannot rely on values that are not stated.
void check_descriptor(TomlReader& file, DeviceDescriptor& device) {
  for (const char* key : {"name", "max_force", "damping", "resolution", "delay"}) file.require(key);
  file.each_text("usb", [&](const std::string& id) { device.usb.push_back(parse_usb_id(id)); });
  if (file.has("name") && device.name.empty())
    file.problem("name", "'name' is empty: write the name of the product");
  check_kind(file, device);
  check_axes(file, device);
  if (device.axes == 6 && !(device.damping > 0))
    file.problem("damping", "a device of six axes needs damping: set it above 0");
  if (device.continuous_force > device.max_force)
    file.problem("continuous_force", "'continuous_force' exceeds max_force: lower or remove it");
  if (!((device.work_space.to - device.work_space.from).minCoeff() > 0))
    file.problem("work_space", "'to' must be greater than 'from' along each axis");
}

Section<WorkSpaceCorners> work_space_keys() {
  return {
      {{"from", &WorkSpaceCorners::from, within("m", -10, 10), "least position along each axis"},
       {"to", &WorkSpaceCorners::to, within("m", -10, 10), "greatest place"}}};
}

const Section<DeviceDescriptor>& descriptor_section() {
  using Device = DeviceDescriptor;
  const auto no_ids = [](const Device&) { return std::vector<std::string>(); };
  static const Section<Device> section{
      {
          {"name", &Device::name, "of the product"},
          {"usb", no_ids,
           "its USB IDs, vendor and product, as \"0403:cb48\"; when absent, it is not on USB"},
          {"kind", &Device::kind,
           "impedance: it reports its position and takes a force; admittance: it reports a force "
           "and takes a position; coefficients: it takes a force model. A descriptor must be "
           "impedance"},
          {"axes", &Device::axes, within("", 1, 8), "3; or 6: it also rotates and displays torque"},
          {"max_force", &Device::max_force, declared("N", 0.01, 1e3),
           "greatest force that it can display; permanently, unless continuous_force is lower"},
          {"continuous_force", &Device::continuous_force, within("N", 0, 1e3),
           "greatest force that its motors can hold permanently; warm motors are limited to it; 0: "
           "max_force"},
          {"thermal_time", &Device::thermal_time, within("s", 1, 3600),
           "time constant of heating and cooling of its motors"},
          {"damping", &Device::damping, declared("N s/m", 0, 1e3),
           "guaranteed viscous friction at the handle, at any position"},
          {"joint_damping", &Device::joint_damping, within("N m s/rad", 0, 10),
           "guaranteed viscous friction of each joint; it replaces `damping` if the driver knows "
           "the joints (Falcon, Polhem); 0: unknown"},
          {"resolution", &Device::resolution, declared("m", 0, 1e-3),
           "step of its position sensors at the handle, along each axis; 0: exact"},
          {"delay", &Device::delay, declared("s", 0, 0.1),
           "from a command to its force at the handle"},
          {"max_stiffness", &Device::max_stiffness, within("N/m", 0, 1e6),
           "greatest stiffness that it can display; 0: as damping, rate and delay allow"},
          {"max_speed", &Device::max_speed, within("m/s", 0.01, 100),
           "faster motion switches the force off for a moment"},
          {"mass", &Device::mass, within("kg", 1e-3, 100), "apparent mass at the handle"},
          {"friction", &Device::friction, within("N", 0, 100),
           "dry friction at the handle; a simulated device applies it; it does not allow stiffer "
           "walls"},
          {"work_space", &Device::work_space, work_space_keys(),
           "a box in the device's axes: x to the right, y away from the person, z up"},
          {"max_torque", &Device::max_torque, declared("N m", 1e-4, 100),
           "of six axes: greatest permanent torque"},
          {"turn_damping", &Device::turn_damping, declared("N m s/rad", 1e-6, 10),
           "of six axes: guaranteed viscous friction of rotation, about each axis"},
          {"turn_resolution", &Device::turn_resolution, declared("rad", 0, 0.1),
           "of six axes: step of its angle sensors; 0: exact"},
          {"inertia", &Device::inertia, within("kg m2", 1e-7, 1),
           "of six axes: apparent inertia about each axis"},
      },
      check_descriptor};
  return section;
}

}  // namespace

const std::vector<SceneKey>& device_descriptor_keys() {
  static const std::vector<SceneKey> keys = descriptor_section().keys("");
  return keys;
}

std::string device_descriptor_markdown() { return keys_markdown(device_descriptor_keys()); }

DeviceDescriptor parse_device_descriptor(std::string_view text, const std::string& file) {
  const toml::table document = parse_toml(text, file);
  const SceneVocabulary vocabulary{device_descriptor_keys(), {}};
  std::vector<SceneProblem> problems;
  DeviceDescriptor device;
  TomlReader reader(document, "", {}, vocabulary, problems);
  descriptor_section().read(reader, device);
  throw_problems(file, std::move(problems));
  return device;
}

DeviceDescriptor load_device_descriptor(const std::filesystem::path& file) {
  return parse_device_descriptor(read_bytes(file, kMostTomlOctets), file.string());
}

}  // namespace reckon::peer

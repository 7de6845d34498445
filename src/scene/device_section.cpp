// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[device]]: the simulated devices of the peers.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

constexpr std::size_t kLongestMarking = 11;
constexpr double kStandardRate = 1000;  // [Hz]
// [Hz]; a device drops its force if nothing is written for kWatchdog. A servo that misses one
// period, and is half a period late for the next, must stay below that.
constexpr double kLeastRate = 2.5e3 / haptics::HapticDevice::kWatchdog.count();

void check_operator_number(TomlReader& table, std::size_t operators, const DeviceConfig& device) {
  if (device.operator_number <= operators) return;
  table.problem("operator", fmt::format("there is no [[operator]] {}: the file has {}; name one of "
                                        "them or add one",
                                        device.operator_number, operators));
}

// A pointer uses its operator only for the start position and the grip.
void check_pointer(TomlReader& table, const std::vector<OperatorConfig>& operators,
                   const DeviceConfig& device) {
  if (device.source != DeviceSource::pointer) {
    if (table.has("reach"))
      table.problem("reach", "'reach' needs kind = \"pointer\": add it, or remove 'reach'");
    return;
  }
  if (device.operator_number > operators.size()) return;
  const OperatorConfig& config = operators[device.operator_number - 1];
  if (config.kind != OperatorKind::passive) {
    table.problem("kind", fmt::format("the pointer and [[operator]] {} both move the hand: write "
                                      "passive = true and a start position there",
                                      device.operator_number));
  }
  if (!(config.damping > 0)) {
    table.problem("kind", fmt::format("the grip of a pointer needs damping, or the hand "
                                      "oscillates: [[operator]] {} has 0 N s/m; 3 is usual",
                                      device.operator_number));
  }
}

// A page's pointer gives the position of the hand directly, without a handle.
void check_mapping(TomlReader& table, const DeviceConfig& device) {
  for (const char* key : {"scale", "left_handed", "clutch_button"}) {
    if (device.source == DeviceSource::pointer && table.has(key))
      table.problem(key, fmt::format("'{}' does not apply to a pointer: remove it", key));
  }
  if (device.clutch_button >= 0 && device.clutch_button == device.stop_button)
    table.problem("clutch_button", fmt::format("button {} already stops all forces: choose another",
                                               device.stop_button));
  const int grabs = static_cast<int>(device.grab_button);
  if (table.has("grab_button") && (grabs == device.stop_button || grabs == device.clutch_button))
    table.problem(
        "grab_button",
        fmt::format("button {} is already the stop or the clutch: choose another", grabs));
}

// An admittance device has a virtual handle with a mass.
void check_admittance(TomlReader& table, const DeviceConfig& device) {
  if (!(device.admittance.mass > 0)) {
    for (const char* key : {"bandwidth", "sensor_stiffness", "motion_loop"}) {
      if (table.has(key))
        table.problem(
            key, fmt::format("'{}' needs a virtual mass: add virtual_mass = \"2 kg\", or remove it",
                             key));
    }
    return;
  }
  if (device.driver != nullptr)
    table.problem("virtual_mass",
                  "only a simulated device has a virtual mass: remove 'virtual_mass' or 'driver'");
  if (device.source == DeviceSource::pointer)
    table.problem(
        "virtual_mass",
        "a pointer needs an impedance device: remove 'virtual_mass', or kind = \"pointer\"");
  if (device.axes == 6)
    table.problem("virtual_mass",
                  "a virtual mass has no rotation: remove 'virtual_mass', or axes = 6");
  if (!(device.damping > 0))
    table.problem("damping", "a virtual mass needs damping, or no wall is stable: set it above 0");
  if (table.has("resolution"))
    table.problem("resolution", "the position of a virtual mass is exact: remove 'resolution'");
}

// Called before the table's keys, which override the descriptor.
void read_descriptor(TomlReader& table, DeviceConfig& device) {
  std::string name;
  table.read("descriptor", name);
  if (!table.has("descriptor")) return;
  try {
    const std::filesystem::path file = find_device_descriptor(name, table.folder());
    describe(device, load_device_descriptor(file));
    device.descriptor = file.string();
  } catch (const std::runtime_error& error) {
    table.problem("descriptor", fmt::format("'descriptor': {}", error.what()));
  } catch (const std::invalid_argument& error) {
    table.problem("descriptor", fmt::format("'descriptor': {}", error.what()));
  }
}

}  // namespace

void check_marking(TomlReader& table, const std::string& marking) {
  const auto strange = std::ranges::find_if(marking, [](char c) { return c < 0x20 || c > 0x7E; });
  if (strange != marking.end()) {
    return table.problem("marking",
                         "'marking' has a character that is not printable ASCII: remove it");
  }
  if (marking.size() > kLongestMarking) {
    table.problem("marking", fmt::format("'marking' has {} characters; use at most {}",
                                         marking.size(), kLongestMarking));
  }
}

std::optional<Attitude> read_attitude(TomlReader& table) {
  if (!table.has("heading") && !table.has("pitch") && !table.has("roll")) return std::nullopt;
  Attitude attitude;
  table.read("heading", attitude.heading);
  table.read("pitch", attitude.pitch);
  table.read("roll", attitude.roll);
  return attitude;
}

void check_axes(TomlReader& table, const DeviceConfig& device) {
  if (!device.described.name.empty() && table.has("axes"))
    return table.problem("axes", "the descriptor gives the number of axes: remove 'axes'");
  if (device.axes != 3 && device.axes != 6)
    return table.problem("axes", "a device has 3 axes, or 6 with torque: write 3 or 6");
  if (device.axes == 6) {
    if (device.source == DeviceSource::pointer)
      table.problem("axes", "a pointer moves three axes: remove axes = 6, or kind = \"pointer\"");
    if (const haptics::UsbFacts* const facts = usb_facts_of(device)) {
      table.problem("axes",
                    fmt::format("a {} has three axes: remove axes = 6, or driver", facts->name));
    }
    if (!(device.damping > 0))
      table.problem("damping", "a device of six axes needs damping: set it above 0");
    if (device.probes.size() > haptics::kMostProbes) {
      table.problem("probe",
                    fmt::format("a tool has at most {} probes, and this one has {}: remove some",
                                haptics::kMostProbes, device.probes.size()));
    }
    return;
  }
  for (const char* key : {"turn_damping", "max_torque", "turn_resolution", "probe"}) {
    if (table.has(key))
      table.problem(key, fmt::format("'{0}' needs axes = 6: add it, or remove '{0}'", key));
  }
}

// Checks the motors of a device driven by the servo.
void check_motors(TomlReader& table, const DeviceConfig& device) {
  if (table.has("thermal_time") && !(device.continuous_force > 0))
    table.problem("thermal_time", "'thermal_time' needs continuous_force: add it");
  if (!table.has("continuous_force")) return;
  if (device.continuous_force > device.max_force) {
    table.problem(
        "continuous_force",
        fmt::format("{:.3g} N exceed its max_force of {:.3g} N: lower or remove 'continuous_force'",
                    device.continuous_force, device.max_force));
  }
  if ((device.driver != nullptr && device.driver->is_cooled) || device.admittance.mass > 0)
    table.problem("continuous_force",
                  "this device protects its motors itself: remove 'continuous_force'");
}

void check_device(TomlReader& table, DeviceConfig& device) {
  check_marking(table, device.marking);
  check_axes(table, device);
  device.is_placed = table.has("position");
  const auto attitude = read_attitude(table);
  if (attitude) device.orientation = device_orientation_of(*attitude);
  if (attitude && table.has("orientation")) {
    table.problem("orientation",
                  "'orientation' and heading, pitch or roll both rotate it: keep one");
  }
  if (!attitude) device.orientation = read_orientation(table);

  double rate = kStandardRate;
  table.read("rate", rate);
  device.period = to_nanoseconds(1.0 / rate);
  std::chrono::nanoseconds delay = device.described.delay;
  table.read("delay", delay);
  device.delay_samples = samples_of(delay, device.period);
  check_mapping(table, device);
  check_admittance(table, device);
  check_motors(table, device);
  check_device_driver(table, device);
}

namespace {

using Device = DeviceConfig;

Section<ProbeConfig> probe_section() {
  return {{{"position", &ProbeConfig::position, within("m", -0.5, 0.5),
            "relative to the handle, in the tool's axes"}}};
}

// Keys for its place and its driver.
std::vector<Row<Device>> driver_rows() {
  const auto no_text = [](const Device&) { return std::string(); };
  std::vector<Row<Device>> rows{
      {"peer", &Device::peer, within("", 1, kMostPeers), "number of its peer"},
      {"operator", &Device::operator_number, within("", 1, 65535),
       "number of the [[operator]] that holds it"},
      {"kind", &Device::source,
       "who moves it: its operator, or a pointer, which starts at the position of its passive "
       "operator"},
      driver_row(),
      {"descriptor", no_text,
       "file with the properties of the device, or the name of one that comes with Reckon; keys "
       "here override it: docs/devices.md"},
  };
  for (const Driver* driver : drivers())
    for (const DriverKey& key : driver->keys) rows.push_back(driver_key_row(key));
  return rows;
}

// Keys for the motion of the handle and its position.
std::vector<Row<Device>> handle_rows() {
  return {
      {"virtual_mass", in(&Device::admittance, &AdmittanceConfig::mass), declared("kg", 0.05, 100),
       "makes it a simulated admittance device: it measures the hand's force and moves as this "
       "mass under the forces of hand and scene, with `damping`; when absent, it is an impedance "
       "device"},
      {"bandwidth", in(&Device::admittance, &AdmittanceConfig::bandwidth), within("Hz", 1, 1000),
       "with a virtual mass: bandwidth of its motion control"},
      {"sensor_stiffness", in(&Device::admittance, &AdmittanceConfig::sensor_stiffness),
       within("N/m", 100, 1e6),
       "with a virtual mass: stiffness of the sensor between hand and handle"},
      {"motion_loop", in(&Device::admittance, &AdmittanceConfig::loop),
       "with a virtual mass: its command is a position or a velocity"},
      {"reach", &Device::reach, within("m", 0.001, 10),
       "of a pointer: greatest distance of the hand from its start, along each axis of the device"},
      {"marking", &Device::marking,
       "of its hand, at most 11 printable ASCII characters; when absent, the peer's name and a "
       "number"},
      {"position", &Device::position, within("m", -kWorld, kWorld),
       "of its origin, in S; when absent, the origin of a real device is where its operator "
       "starts"},
  };
}

// Keys for its motors, axes and buttons.
std::vector<Row<Device>> motor_rows() {
  const auto no_turn = [](const Device&) { return Eigen::Vector3d(0, 0, 0); };
  return {
      {"orientation", no_turn, within("rad", -4 * std::numbers::pi, 4 * std::numbers::pi),
       "instead: rotations about S's x, then y, then z axis"},
      {"max_force", &Device::max_force, within("N", 0.1, 1e3),
       "greatest force that it can display"},
      {"continuous_force", &Device::continuous_force, within("N", 0, 1e3),
       "greatest force that its motors can hold permanently; warm motors are limited to it; 0: "
       "max_force"},
      {"thermal_time", &Device::thermal_time, within("s", 1, 3600),
       "time constant of heating and cooling of its motors"},
      {"damping", &Device::damping, within("N s/m", 0, 1e3),
       "guaranteed viscous friction of the device; more allows stiffer walls"},
      {"joint_damping", &Device::joint_damping, within("N m s/rad", 0, 10),
       "of a driver that knows the joints, instead of `damping`: guaranteed viscous friction of "
       "each joint; the servo computes that of the handle for each pose; 0: unknown"},
      {"axes", &Device::axes, within("", 3, 6), "3; or 6: it also rotates and displays torque"},
      {"turn_damping", &Device::turn_damping, within("N m s/rad", 1e-5, 10),
       "of six axes: guaranteed viscous friction of rotation, about each axis"},
      {"max_torque", &Device::max_torque, within("N m", 1e-3, 100),
       "of six axes: greatest torque that it can display"},
      {"turn_resolution", &Device::turn_resolution, within("rad", 0, 0.1),
       "of six axes: step of its angle sensors; 0: exact"},
      {"grab_button", &Device::grab_button, within("", 0, 31),
       "number of the button, from 0, that holds bodies; see grab_stiffness of [hand]"},
      {"probe", &Device::probes, probe_section(),
       "of six axes: a contact point of the tool, at most 8; remote hands touch the first; when "
       "absent, the handle"},
  };
}

// Keys for limits of its servo.
std::vector<Row<Device>> servo_rows() {
  const auto rate = [](const Device&) { return kStandardRate; };
  const auto no_delay = [](const Device&) { return std::chrono::nanoseconds(0); };
  return {
      {"max_stiffness", &Device::max_stiffness, within("N/m", 0, 1e6),
       "greatest stiffness that it can display; 0: as damping, rate and delay allow"},
      {"max_speed", &Device::max_speed, within("m/s", 0.01, 100),
       "faster motion switches the force off for a moment"},
      {"max_force_rate", &Device::max_force_rate, within("N/s", 0, 1e6),
       "greatest rate at which its force grows or rotates; its decrease is free; 0, and the upper "
       "limit: the rate of the stiffest wall at 1 m/s"},
      {"received_power", &Device::received_power, within("W", 1e-3, 100),
       "greatest average power of others on its hand through their contacts; more is delayed, and "
       "false reports of energy cannot exceed it"},
      {"region_loan", in(&Device::regions, &RegionEnergyConfig::loan), within("J", 0, 1),
       "greatest energy lent to springs, magnets, borders and constant forces of all regions "
       "together, until it returns; 0: the hand's motion must supply it"},
      {"oscillation_power", in(&Device::regions, &RegionEnergyConfig::oscillation_power),
       within("W", 0, 10),
       "greatest average power of oscillations of regions on its hand; above it they are weaker"},
      {"oscillation_energy", in(&Device::regions, &RegionEnergyConfig::oscillation_energy),
       within("J", 0, 1),
       "greatest energy of oscillations of regions at once, beyond oscillation_power"},
      {"resolution", &Device::resolution, within("m", 0, 1e-3),
       "step of its position sensors, along each of its axes; 0: exact"},
      {"stop_button", &Device::stop_button, declared("", 0, 31),
       "number of the button that switches all forces of the program off until it is pressed "
       "again; when absent, none does"},
      {"scale", &Device::scale, within("", 0.01, 100),
       "displacement of the hand in S per displacement of the handle; the power stays equal, so "
       "forces in S are divided by it, and stiffness by its square"},
      {"left_handed", &Device::left_handed,
       "swaps left and right: positions, forces and rotations are mirrored at the plane of its y "
       "and z axes"},
      {"clutch_button", &Device::clutch_button, declared("", 0, 31),
       "number of the button that, while down, lets the handle move without the hand and without "
       "force; when absent, none does"},
      {"rate", rate, within("Hz", kLeastRate, 10e3),
       "of its servo; at the least rate, one missed period stays below the 10 ms after which a "
       "device drops its force"},
      {"delay", no_delay, within("s", 0, 0.1),
       "from a command to its force at the handle, rounded up to whole servo periods"},
  };
}

}  // namespace

Section<DeviceConfig> device_section() {
  Section<Device> section{{}, check_device};
  for (const auto& rows :
       {driver_rows(), handle_rows(), attitude_rows<Device>(), motor_rows(), servo_rows()})
    section.rows.insert(section.rows.end(), rows.begin(), rows.end());
  return section;
}

void read_devices(TomlReader& file, SceneFile& out) {
  static const Section<DeviceConfig> section = device_section();
  for (TomlReader& table : file.tables("device")) {
    DeviceConfig& device = out.devices.emplace_back();
    read_descriptor(table, device);
    section.read(table, device);
    check_operator_number(table, out.operators.size(), device);
    check_pointer(table, out.operators, device);
  }
}

}  // namespace reckon::peer

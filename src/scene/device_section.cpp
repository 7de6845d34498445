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
      table.problem("reach", "only a pointer has a reach: add kind = \"pointer\", or take it out");
    return;
  }
  if (device.operator_number > operators.size()) return;
  const OperatorConfig& config = operators[device.operator_number - 1];
  if (config.kind != OperatorKind::passive) {
    table.problem("kind",
                  fmt::format("a pointer moves the hand, and so would [[operator]] {}: give "
                              "that passive = true and the position where the hand starts",
                              device.operator_number));
  }
  if (!(config.damping > 0)) {
    table.problem("kind", fmt::format("a pointer needs a grip with damping, or the hand swings: "
                                      "[[operator]] {} says 0 N s/m, 3 is usual",
                                      device.operator_number));
  }
}

// A page's pointer gives the position of the hand directly, without a handle.
void check_mapping(TomlReader& table, const DeviceConfig& device) {
  for (const char* key : {"scale", "left_handed", "clutch_button"}) {
    if (device.source == DeviceSource::pointer && table.has(key))
      table.problem(key, fmt::format("a pointer has no '{}': take it out", key));
  }
  if (device.clutch_button >= 0 && device.clutch_button == device.stop_button)
    table.problem("clutch_button", fmt::format("button {} already stops all forces: name another",
                                               device.stop_button));
  const int grabs = static_cast<int>(device.grab_button);
  if (table.has("grab_button") && (grabs == device.stop_button || grabs == device.clutch_button))
    table.problem(
        "grab_button",
        fmt::format("button {} already stops all forces, or is the clutch: name another", grabs));
}

// An admittance device has a virtual handle with a mass.
void check_admittance(TomlReader& table, const DeviceConfig& device) {
  if (!(device.admittance.mass > 0)) {
    for (const char* key : {"bandwidth", "sensor_stiffness", "motion_loop"}) {
      if (table.has(key))
        table.problem(key, fmt::format("only a device that moves by itself has '{}': add "
                                       "virtual_mass = \"2 kg\", or take it out",
                                       key));
    }
    return;
  }
  if (device.driver != nullptr)
    table.problem("virtual_mass",
                  "only a simulated device moves by itself: take it out, or driver");
  if (device.source == DeviceSource::pointer)
    table.problem("virtual_mass",
                  "a pointer holds a device that takes forces: take it out, or "
                  "kind = \"pointer\"");
  if (device.axes == 6)
    table.problem("virtual_mass", "a virtual mass does not turn: take it out, or axes = 6");
  if (!(device.damping > 0))
    table.problem("damping", "a virtual mass needs damping, or nothing pays for walls");
  if (table.has("resolution"))
    table.problem("resolution", "the place of a virtual mass is computed and exact: take it out");
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
    return table.problem("marking", "'marking' has a letter that is not ASCII: write it without");
  }
  if (marking.size() > kLongestMarking) {
    table.problem("marking", fmt::format("'marking' has {} letters; at most {} fit on the wire",
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
    return table.problem("axes", "its descriptor says how many axes it has: take the key out");
  if (device.axes != 3 && device.axes != 6)
    return table.problem("axes", "a device has 3 axes, or 6 with torque: write one of them");
  if (device.axes == 6) {
    if (device.source == DeviceSource::pointer)
      table.problem("axes", "a pointer moves three axes: take out axes = 6, or kind = \"pointer\"");
    if (const haptics::UsbFacts* const facts = usb_facts_of(device)) {
      table.problem("axes",
                    fmt::format("a {} has three axes: take out axes = 6, or driver", facts->name));
    }
    if (!(device.damping > 0))
      table.problem("damping", "a device of six axes needs damping in all of them");
    if (device.probes.size() > haptics::kMostProbes) {
      table.problem("probe", fmt::format("a tool has at most {} probes, this one has {}",
                                         haptics::kMostProbes, device.probes.size()));
    }
    return;
  }
  for (const char* key : {"turn_damping", "max_torque", "turn_resolution", "probe"}) {
    if (table.has(key))
      table.problem(key, fmt::format("only a device that turns has '{}': add axes = 6", key));
  }
}

// Checks the motors of a device driven by the servo.
void check_motors(TomlReader& table, const DeviceConfig& device) {
  if (table.has("thermal_time") && !(device.continuous_force > 0))
    table.problem("thermal_time", "nothing becomes warm without continuous_force: add it");
  if (!table.has("continuous_force")) return;
  if (device.continuous_force > device.max_force) {
    table.problem("continuous_force",
                  fmt::format("{:.3g} N are more than its max_force of {:.3g} N: take it out, or "
                              "state less",
                              device.continuous_force, device.max_force));
  }
  if ((device.driver != nullptr && device.driver->is_cooled) || device.admittance.mass > 0)
    table.problem("continuous_force",
                  "such a device looks after its motors itself: take the key out");
}

void check_device(TomlReader& table, DeviceConfig& device) {
  check_marking(table, device.marking);
  check_axes(table, device);
  device.is_placed = table.has("position");
  const auto attitude = read_attitude(table);
  if (attitude) device.orientation = device_orientation_of(*attitude);
  if (attitude && table.has("orientation")) {
    table.problem("orientation",
                  "it is turned twice, by orientation and by heading, pitch or roll: keep one");
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
            "from the handle, in the tool's axes"}}};
}

// Keys for its place and its driver.
std::vector<Row<Device>> driver_rows() {
  const auto no_text = [](const Device&) { return std::string(); };
  std::vector<Row<Device>> rows{
      {"peer", &Device::peer, within("", 1, kMostPeers), "number of the peer it stands at"},
      {"operator", &Device::operator_number, within("", 1, 65535),
       "which [[operator]] of the file holds it"},
      {"kind", &Device::source,
       "who moves it: its operator; or a pointer, from where its operator, a passive one, "
       "holds "
       "it at first"},
      driver_row(),
      {"descriptor", no_text,
       "file of what it is and can do, or the name of one that comes with Reckon; keys here go "
       "before it: docs/devices.md"},
  };
  for (const Driver* driver : drivers())
    for (const DriverKey& key : driver->keys) rows.push_back(driver_key_row(key));
  return rows;
}

// Keys for the motion of the handle and its position.
std::vector<Row<Device>> handle_rows() {
  return {
      {"virtual_mass", in(&Device::admittance, &AdmittanceConfig::mass), declared("kg", 0.05, 100),
       "makes it an admittance device, simulated: it measures the hand's force and goes where "
       "a mass would go that hand and scene push, braked by `damping`; absent: it takes "
       "forces"},
      {"bandwidth", in(&Device::admittance, &AdmittanceConfig::bandwidth), within("Hz", 1, 1000),
       "with a virtual mass: of the device's own motion"},
      {"sensor_stiffness", in(&Device::admittance, &AdmittanceConfig::sensor_stiffness),
       within("N/m", 100, 1e6), "with a virtual mass: of the sensor between hand and handle"},
      {"motion_loop", in(&Device::admittance, &AdmittanceConfig::loop),
       "with a virtual mass: whether its command is a position or a velocity"},
      {"reach", &Device::reach, within("m", 0.001, 10),
       "of a pointer: so far from there it takes the hand, along each axis of the device"},
      {"marking", &Device::marking,
       "of its hand, at most 11 printable ASCII characters; absent: the peer's name and a "
       "number"},
      {"position", &Device::position, within("m", -kWorld, kWorld),
       "of its own origin, in S; absent: of a real device where its operator begins"},
  };
}

// Keys for its motors, axes and buttons.
std::vector<Row<Device>> motor_rows() {
  const auto no_turn = [](const Device&) { return Eigen::Vector3d(0, 0, 0); };
  return {
      {"orientation", no_turn, within("rad", -4 * std::numbers::pi, 4 * std::numbers::pi),
       "instead: turned about S's x, then y, then z axis"},
      {"max_force", &Device::max_force, within("N", 0.1, 1e3), "it can show"},
      {"continuous_force", &Device::continuous_force, within("N", 0, 1e3),
       "that its motors hold for ever: once they are warm, no more is shown; 0: max_force"},
      {"thermal_time", &Device::thermal_time, within("s", 1, 3600),
       "time constant with which its motors become warm and cool down"},
      {"damping", &Device::damping, within("N s/m", 0, 1e3),
       "its own friction that one is sure of; the stiffness that it can show grows with it"},
      {"joint_damping", &Device::joint_damping, within("N m s/rad", 0, 10),
       "of a device whose joints its driver knows, in the place of `damping`: the friction of each "
       "joint that one is sure of; the servo knows what it is at the handle, pose by pose; 0: not "
       "said"},
      {"axes", &Device::axes, within("", 3, 6),
       "3; or 6: it turns, and shows torque besides the force"},
      {"turn_damping", &Device::turn_damping, within("N m s/rad", 1e-5, 10),
       "of six axes: its own friction in turning that one is sure of, about each axis"},
      {"max_torque", &Device::max_torque, within("N m", 1e-3, 100), "of six axes: it can show"},
      {"turn_resolution", &Device::turn_resolution, within("rad", 0, 0.1),
       "of six axes: step of its angle sensors; 0: exact"},
      {"grab_button", &Device::grab_button, within("", 0, 31),
       "its button, from 0, by which the hand holds bodies; see grab_stiffness of [hand]"},
      {"probe", &Device::probes, probe_section(),
       "of six axes: a place of the tool that touches, at most 8; remote hands touch the first. "
       "None: the handle"},
  };
}

// Keys for limits of its servo.
std::vector<Row<Device>> servo_rows() {
  const auto rate = [](const Device&) { return kStandardRate; };
  const auto no_delay = [](const Device&) { return std::chrono::nanoseconds(0); };
  return {
      {"max_stiffness", &Device::max_stiffness, within("N/m", 0, 1e6),
       "it can show; 0: as much as damping, rate and delay allow"},
      {"max_speed", &Device::max_speed, within("m/s", 0.01, 100), "faster readings cut the force"},
      {"max_force_rate", &Device::max_force_rate, within("N/s", 0, 1e6),
       "fastest growth and turning of its force, which falls as it likes; 0, and at most: what the "
       "stiffest wall that it can show gives at 1 m/s"},
      {"received_power", &Device::received_power, within("W", 1e-3, 100),
       "most that others put into its hand through their contacts, on average; what they give "
       "beyond it waits, and a liar throws the hand no harder"},
      {"region_loan", in(&Device::regions, &RegionEnergyConfig::loan), within("J", 0, 1),
       "most that is lent to springs, magnets, borders and constant forces of regions, all "
       "together and until it is back; 0: the hand's motion has to pay for them"},
      {"oscillation_power", in(&Device::regions, &RegionEnergyConfig::oscillation_power),
       within("W", 0, 10),
       "most that oscillations of regions put into its hand, on average; beyond it they are "
       "weaker"},
      {"oscillation_energy", in(&Device::regions, &RegionEnergyConfig::oscillation_energy),
       within("J", 0, 1),
       "most that oscillations of regions put in at once, beyond oscillation_power"},
      {"resolution", &Device::resolution, within("m", 0, 1e-3),
       "step of its position sensors, along each of its axes; 0: exact"},
      {"stop_button", &Device::stop_button, declared("", 0, 31),
       "number of its button that takes all forces of the program off, until it is pressed again; "
       "absent: none does"},
      {"scale", &Device::scale, within("", 0.01, 100),
       "ways of the hand in S for one of the handle; its force and its stiffness in S are as much "
       "smaller as keeps the power and the handle's own limits"},
      {"left_handed", &Device::left_handed,
       "its left and right change sides, as in a mirror along its y and z axes, forces and turns "
       "with them"},
      {"clutch_button", &Device::clutch_button, declared("", 0, 31),
       "number of its button that lets the handle move without the hand, and without force, while "
       "it is down; absent: none does"},
      {"rate", rate, within("Hz", kLeastRate, 10e3),
       "of its servo; a device lets go after 10 ms without a force, which one missed period must "
       "not bring about"},
      {"delay", no_delay, within("s", 0, 0.1),
       "until a force is at the handle; whole servo periods, rounded up"},
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

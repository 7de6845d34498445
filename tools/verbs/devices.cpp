// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ranges>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/device_stiffness.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/attached_devices.hpp"
#include "reckon/tools/exercise/device_measuring.hpp"
#include "reckon/tools/exercise/real_measuring.hpp"
#include "reckon/tools/terminal/foreign_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

// A driver for examples.
std::string_view example() { return peer::drivers().front()->name; }

struct DevicesOptions {
  std::string action, name, simulate, max_force;
  DeviceChoice choice;  // the flags of drivers
  bool is_agreed = false;
  bool install_rule = false;
  std::string folder = kRuleFolder;
  bool json = false;
};

int install_rule(const DevicesOptions& options, const Console& console) {
  const auto file = std::filesystem::path(options.folder) / kRuleFile;
  errno = 0;
  std::ofstream out(file);
  out << udev_rule();
  if (!out.flush()) {
    throw EnvironmentError(fmt::format("{}: {}; run it with sudo", file.string(),
                                       std::generic_category().message(errno)));
  }
  fmt::print(console.out,
             "{} is written; plug the device in again, or: sudo udevadm control --reload && sudo "
             "udevadm trigger --subsystem-match=usb --subsystem-match=input "
             "--subsystem-match=hidraw\n",
             file.string());
  return exit_status(ExitCode::good);
}

void print_json(std::FILE* out, const AttachedDevice& device) {
  std::string line;
  JsonObject(line)
      .text("driver", device.driver)
      .text("name", device.name)
      .text("use", device.use)
      .text("problem", device.problem)
      .text("remedy", device.remedy)
      .end("\n");
  std::fwrite(line.data(), 1, line.size(), out);
}

void print_device(std::FILE* out, const AttachedDevice& device) {
  fmt::print(out, "{:<8} {}\n         {}\n", device.driver, clean_lines(device.name), device.use);
  if (!device.problem.empty()) fmt::print(out, "         not now: {}\n", device.problem);
  if (!device.remedy.empty()) fmt::print(out, "         fix: {}\n", device.remedy);
}

int list_devices(const DevicesOptions& options, const Console& console) {
  UsbLook look = look_at_usb(true);
  std::ranges::move(look_beside_usb(), std::back_inserter(look.devices));
  const std::vector<AttachedDevice> lines = peer::driver_ports();
  if (!look.problem.empty() && look.devices.empty() && lines.empty())
    throw EnvironmentError(look.problem + "; see reckon doctor");
  const auto print = [&](const AttachedDevice& device) {
    options.json ? print_json(console.out, device) : print_device(console.out, device);
  };
  std::ranges::for_each(look.devices, print);
  std::ranges::for_each(lines, print);
  fmt::print(console.err, "{} with a driver, {} on USB, {} for boards; drivers: {}\n",
             counted(look.devices.size(), "device"), counted(look.others, "other"),
             counted(lines.size(), "serial line"),
             fmt::join(peer::driver_names() | std::views::drop(1), ", "));
  const auto has_problem = [](const AttachedDevice& device) { return !device.problem.empty(); };
  const bool any = std::ranges::any_of(look.devices, has_problem);
  const bool needs_rule = std::ranges::any_of(look.devices, [](const AttachedDevice& device) {
    return device.remedy.find("--install-rule") != std::string::npos;
  });
  if (needs_rule && !options.json)
    fmt::print(console.err, "--install-rule writes this rule:\n{}", udev_rule());
  return exit_status(any ? ExitCode::findings : ExitCode::good);
}

/// The stiffness that a 1 kHz servo can show with it.
peer::DeviceStiffness stiffness_of(const peer::DeviceDescriptor& device) {
  haptics::SimulatedDevice simulated(free_device_of(device));
  const haptics::ServoLoop servo(simulated, haptics::EffectPlan(), {});
  return peer::stiffness_of(servo, peer::HandModel());
}

std::string ids_of(const peer::DeviceDescriptor& device) {
  std::string text;
  for (const peer::UsbId& id : device.usb)
    text += fmt::format("{}{:04x}:{:04x}", text.empty() ? "" : ", ", id.vendor, id.product);
  return text.empty() ? "no USB" : "USB " + text;
}

void print_descriptor(std::FILE* out, const std::filesystem::path& file,
                      const peer::DeviceDescriptor& device) {
  const auto say = [](double value, std::string_view unit) {
    return peer::format_quantity(value, unit);
  };
  const auto line = [out](std::string_view what, const std::string& how) {
    fmt::print(out, "  {:<14} {}\n", what, how);
  };
  const Eigen::Vector3d size = 1e3 * (device.work_space.to - device.work_space.from);
  const peer::DeviceStiffness can = stiffness_of(device);
  fmt::print(out, "{}  {}\n", clean_lines(device.name), file.string());
  line("is", fmt::format("{} axes, {}", device.axes, ids_of(device)));
  const std::string lasting =
      device.continuous_force > 0
          ? fmt::format(", {} permanently (heats up in {})", say(device.continuous_force, "N"),
                        say(device.thermal_time, "s"))
          : "";
  line("limits",
       fmt::format("{}{}, {}", say(device.max_force, "N"), lasting, say(device.max_speed, "m/s")));
  line("feels like", fmt::format("{}, {} guaranteed, dry friction {}", say(device.mass, "kg"),
                                 say(device.damping, "N s/m"), say(device.friction, "N")));
  if (device.axes == 6)
    line("turns", fmt::format("{}, {}, {} guaranteed", say(device.max_torque, "N m"),
                              say(device.inertia, "kg m2"), say(device.turn_damping, "N m s/rad")));
  line("sensors", fmt::format("steps of {}; a force acts after {}", say(device.resolution, "m"),
                              say(pdu::to_seconds(device.delay), "s")));
  line("work space", fmt::format("{:.4g} x {:.4g} x {:.4g} mm", size.x(), size.y(), size.z()));
  line("so at 1 kHz",
       fmt::format("walls up to {:.3g} N/m, hands up to {:.3g} N/m", can.walls, can.hands));
}

void print_descriptor_json(std::FILE* out, const std::filesystem::path& file,
                           const peer::DeviceDescriptor& device) {
  const peer::DeviceStiffness can = stiffness_of(device);
  const auto number = [](double value) { return fmt::format("{:.9g}", value); };
  std::string line;
  JsonObject(line)
      .text("name", device.name)
      .text("file", file.string())
      .value("axes", static_cast<std::uint64_t>(device.axes))
      .value("max_force_n", number(device.max_force))
      .value("continuous_force_n",
             number(device.continuous_force > 0 ? device.continuous_force : device.max_force))
      .value("damping_n_s_m", number(device.damping))
      .value("friction_n", number(device.friction))
      .value("resolution_m", number(device.resolution))
      .value("delay_s", number(pdu::to_seconds(device.delay)))
      .value("mass_kg", number(device.mass))
      .value("walls_n_m", number(can.walls))
      .value("hands_n_m", number(can.hands))
      .end("\n");
  std::fwrite(line.data(), 1, line.size(), out);
}

/// Names of the shipped descriptors.
std::vector<std::string> shipped_descriptors() {
  std::vector<std::string> names;
  for (const std::filesystem::path& folder : peer::device_folders()) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    if (!names.empty()) break;
  }
  std::ranges::sort(names);
  return names;
}

std::filesystem::path file_of(const std::string& name) {
  try {
    return peer::find_device_descriptor(name, std::filesystem::current_path());
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

peer::DeviceDescriptor descriptor_of(const std::string& name) {
  try {
    return peer::load_device_descriptor(file_of(name));
  } catch (const peer::SceneFileError& error) {
    throw UsageError(error.what());
  }
}

int describe_devices(const DevicesOptions& options, const Console& console) {
  const std::vector<std::string> names =
      options.name.empty() ? shipped_descriptors() : std::vector{options.name};
  for (const std::string& name : names) {
    const auto file = file_of(name);
    const peer::DeviceDescriptor device = descriptor_of(name);
    options.json ? print_descriptor_json(console.out, file, device)
                 : print_descriptor(console.out, file, device);
  }
  return exit_status(ExitCode::good);
}

std::string simulated_text(const DevicesOptions& options) {
  const peer::DeviceDescriptor known = descriptor_of(options.simulate);
  haptics::MeasuredDevice found;
  try {
    found = measure_simulated(known);
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(fmt::format("{}: {}", known.name, error.what()));
  }
  return descriptor_text(options.name, known, found);
}

DeviceChoice choice_of(const DevicesOptions& options) {
  DeviceChoice choice = options.choice;
  choice.device = options.name;
  return choice;
}

int measure_device(const DevicesOptions& options, const Console& console) {
  const std::string text =
      options.simulate.empty()
          ? measure_real({choice_of(options), options.max_force, options.is_agreed}, console)
          : simulated_text(options);
  // Checks that the output is a valid descriptor.
  static_cast<void>(peer::parse_device_descriptor(text, options.name));
  std::fwrite(text.data(), 1, text.size(), console.out);
  if (options.simulate.empty())
    fmt::print(console.err,
               "save this as mine.toml, and write descriptor = \"mine.toml\" in its [[device]]{}\n",
               text.find("\nusb = ") != std::string::npos
                   ? ", or run reckon demo --device mine.toml"
                   : "");
  return exit_status(ExitCode::good);
}

void check_measure(const DevicesOptions& options) {
  const bool measures = options.action == "measure";
  if (!options.simulate.empty() && !measures)
    throw UsageError(fmt::format(
        "--simulate needs measure: reckon devices measure mine --simulate {}", example()));
  std::vector<std::string_view> given = driver_flags_of(options.choice);
  if (options.is_agreed) given.emplace_back("--yes");
  if (!options.max_force.empty()) given.emplace_back("--max-force");
  for (const std::string_view flag : given) {
    if (!measures)
      throw UsageError(fmt::format("{} needs measure: reckon devices measure {}", flag, example()));
    if (!options.simulate.empty())
      throw UsageError(fmt::format("{} needs a real device: remove it or --simulate", flag));
  }
  if (!measures) return;
  if (options.name.empty())
    throw UsageError(
        fmt::format("measure needs a device: reckon devices measure {0}, or for a simulated one "
                    "reckon devices measure mine --simulate {0}",
                    example()));
  if (options.json) throw UsageError("--json: measure prints a descriptor; remove --json");
}

void check_flags(const DevicesOptions& options) {
  if (options.install_rule && options.json)
    throw UsageError("--json: --install-rule lists nothing; remove one of them");
  if (!options.install_rule && options.folder != kRuleFolder)
    throw UsageError("--folder needs --install-rule: add it, or remove --folder");
  check_measure(options);
  if (options.action.empty()) return;
  constexpr std::array<std::string_view, 3> kActions{"describe", "keys", "measure"};
  if (std::ranges::find(kActions, options.action) == kActions.end())
    throw UsageError(
        fmt::format("'{}' is not one of {}; write for example reckon devices describe {}",
                    options.action, fmt::join(kActions, ", "), example()));
  if (options.action == "keys" && (options.json || !options.name.empty()))
    throw UsageError("keys prints one table for all descriptors: remove the other arguments");
  if (options.install_rule) throw UsageError("--install-rule takes no action: remove one of them");
}

int run_devices(Arguments arguments, const Console& console) {
  DevicesOptions options;
  CommandLine line("devices", "Lists attached real devices, their use, and problems with remedies.",
                   fmt::format("reckon devices\n"
                               "reckon devices describe\n"
                               "reckon devices describe touch\n"
                               "reckon devices measure {0} > mine.toml\n"
                               "reckon devices measure /dev/ttyACM0 --max-force \"3 N\"\n"
                               "reckon devices measure mine --simulate {0}\n"
                               "sudo reckon devices --install-rule\n"
                               "reckon demo --device {0}",
                               example()));
  line.word("ACTION", options.action, false,
            "describe: show descriptors and the resulting stiffness; keys: list the keys of a "
            "descriptor; measure: measure damping, friction and delay by small pushes, after a "
            "question, and print a descriptor; default: list devices");
  line.word("NAME", options.name, false,
            "describe: a descriptor file, or the name of one that comes with Reckon; default: all "
            "of the latter. measure: a real device as in demo --device, or a name with --simulate");
  line.option("--simulate", options.simulate,
              "measure: push a simulated free device with this descriptor");
  line.flag("--yes", options.is_agreed,
            "measure: start without a question, because the handle is free to move by 40 mm");
  add_driver_flags(line, options.choice, "measure: ");
  line.option(
      "--max-force", options.max_force,
      "measure: permanent force of each axis of a serial board, such as \"3 N\"; default: 1 N");
  line.flag("--install-rule", options.install_rule,
            "write the udev rule that lets the user at this host open devices");
  line.option("--folder", options.folder,
              fmt::format("--install-rule: folder of udev rules; default: {}", kRuleFolder));
  line.flag("--json", options.json, "one JSON object per device");
  if (const auto status = line.parse(arguments, console)) return *status;
  check_flags(options);
  if (options.action == "keys") {
    fmt::print(console.out, "{}", peer::device_descriptor_markdown());
    return exit_status(ExitCode::good);
  }
  if (options.action == "measure") return measure_device(options, console);
  if (!options.action.empty()) return describe_devices(options, console);
  return options.install_rule ? install_rule(options, console) : list_devices(options, console);
}

}  // namespace

namespace verb {

Verb devices() { return verb_of(verb_row("devices"), run_devices); }

}  // namespace verb

}  // namespace reckon::tools

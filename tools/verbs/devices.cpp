// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/exercise/attached_devices.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

struct DevicesOptions {
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
             "udevadm trigger --subsystem-match=usb\n",
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
  fmt::print(out, "{:<8} {}\n         {}\n", device.driver, device.name, device.use);
  if (!device.problem.empty()) fmt::print(out, "         not now: {}\n", device.problem);
  if (!device.remedy.empty()) fmt::print(out, "         fix: {}\n", device.remedy);
}

int list_devices(const DevicesOptions& options, const Console& console) {
  const UsbLook look = look_at_usb(true);
  if (!look.problem.empty()) throw EnvironmentError(look.problem + "; see reckon doctor");
  for (const AttachedDevice& device : look.devices) {
    if (options.json)
      print_json(console.out, device);
    else
      print_device(console.out, device);
  }
  fmt::print(console.err, "{} that can be held, {} on USB; drivers: {}\n",
             counted(look.devices.size(), "device"), counted(look.others, "other"), driver_names());
  const auto has_problem = [](const AttachedDevice& device) { return !device.problem.empty(); };
  const bool any = std::ranges::any_of(look.devices, has_problem);
  const bool needs_rule = std::ranges::any_of(look.devices, [](const AttachedDevice& device) {
    return device.remedy.find("--install-rule") != std::string::npos;
  });
  if (needs_rule && !options.json)
    fmt::print(console.err, "the rule that --install-rule writes:\n{}", udev_rule());
  return exit_status(any ? ExitCode::findings : ExitCode::good);
}

int run_devices(Arguments arguments, const Console& console) {
  DevicesOptions options;
  CommandLine line("devices",
                   "Lists real devices that are attached, how they would be used, and what keeps "
                   "one from being used, with the remedy.",
                   "reckon devices\n"
                   "sudo reckon devices --install-rule\n"
                   "reckon demo --device falcon");
  line.flag("--install-rule", options.install_rule,
            "write the rule of udev by which the person at this host may open them");
  line.option("--folder", options.folder,
              fmt::format("of --install-rule: where rules are; default: {}", kRuleFolder));
  line.flag("--json", options.json, "one JSON object per device");
  if (const auto status = line.parse(arguments, console)) return *status;
  if (options.install_rule && options.json)
    throw UsageError("--json: --install-rule lists nothing; leave one of them out");
  if (!options.install_rule && options.folder != kRuleFolder)
    throw UsageError("--folder is where --install-rule writes: add that, or leave it out");
  return options.install_rule ? install_rule(options, console) : list_devices(options, console);
}

}  // namespace

namespace verb {

Verb devices() {
  return {"devices", "list real devices, and what keeps one from being used", run_devices};
}

}  // namespace verb

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/drivers/driver.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/host_limits.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/peer/threads/awake_processors.hpp"
#include "reckon/tools/command_line/command_line.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/exercise/attached_devices.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

struct DoctorOptions {
  std::string scene;
  std::string interface;
  std::optional<std::uint64_t> groups;
  bool ipv6 = false;
  bool sealed = false;
  bool json = false;
};

/// Text and ANSI colour of a level.
struct LevelText {
  std::string_view word;
  std::string_view colour;
};

LevelText text_of(peer::FindingLevel level) {
  switch (level) {
    case peer::FindingLevel::ok:
      return {"ok", "\x1b[32m"};
    case peer::FindingLevel::note:
      return {"note", "\x1b[36m"};
    case peer::FindingLevel::warning:
      return {"warn", "\x1b[33m"};
    case peer::FindingLevel::problem:
      break;
  }
  return {"fail", "\x1b[31m"};
}

void print_finding(const Console& console, const peer::Finding& finding) {
  const LevelText level = text_of(finding.level);
  const std::string_view colour = console.colour ? level.colour : "";
  fmt::print(console.out, "{}{:<4}{}  {}\n", colour, level.word, console.colour ? "\x1b[0m" : "",
             finding.what);
  if (!finding.remedy.empty()) fmt::print(console.out, "      fix: {}\n", finding.remedy);
}

void print_json(std::FILE* out, const peer::Finding& finding) {
  std::string line;
  JsonObject(line)
      .text("level", text_of(finding.level).word)
      .text("what", finding.what)
      .text("remedy", finding.remedy)
      .end("\n");
  std::fwrite(line.data(), 1, line.size(), out);
}

void print_summary(std::FILE* err, const std::vector<peer::Finding>& findings) {
  const auto count = [&](peer::FindingLevel level) {
    return static_cast<std::uint64_t>(
        std::count_if(findings.begin(), findings.end(),
                      [=](const peer::Finding& finding) { return finding.level == level; }));
  };
  fmt::print(err, "{}: {} ok, {}, {}, {} failed\n", counted(findings.size(), "finding"),
             count(peer::FindingLevel::ok), counted(count(peer::FindingLevel::note), "note"),
             counted(count(peer::FindingLevel::warning), "warning"),
             count(peer::FindingLevel::problem));
}

// Needs of the scene, or of an empty scene.
peer::HostNeeds needs_of(const DoctorOptions& options, const peer::SceneFile& scene) {
  peer::HostNeeds needs;
  if (options.ipv6) needs.pool = peer::GroupPool::ipv6_default();
  if (!options.scene.empty()) {
    needs.pool = peer::pool_of(scene);
    needs.groups = scene.network.interop ? 0 : std::min(scene.aoim.groups, scene.aoim.pool);
    needs.groups += scene.aoim.all_groups() - scene.aoim.pool;
  }
  if (options.sealed || !scene.network.key.empty()) {
    needs.pool = peer::GroupPool(peer::sealed_group(needs.pool.base()), needs.pool.size());
  }
  needs.groups = options.groups.value_or(needs.groups);
  needs.peers = scene.network.peers;
  needs.receive_buffer = peer::receive_room(static_cast<double>(scene.network.rate),
                                            peer::kLongestStall, scene.network.bundle_max);
  needs.longest_bundle = scene.network.bundle_max;
  return needs;
}

// Whether processors can be kept awake while something can be felt.
peer::Finding examine_waking() {
  const std::string file = peer::AwakeProcessors::kRequests;
  if (peer::AwakeProcessors::is_allowed())
    return {peer::FindingLevel::ok,
            file + " is writable: processors stay awake near touchable objects", ""};
  return {
      peer::FindingLevel::note,
      file +
          " is not writable: processors may sleep near touchable objects, and wake the servo late",
      "sudo setfacl -m u:$USER:w " + file + ", or run as root"};
}

void add_findings(const std::vector<AttachedDevice>& devices,
                  std::vector<peer::Finding>& findings) {
  for (const AttachedDevice& device : devices) {
    if (device.problem.empty())
      findings.push_back({peer::FindingLevel::ok, device.name + ": it can be opened", ""});
    else
      findings.push_back(
          {peer::FindingLevel::warning, device.name + ": " + device.problem, device.remedy});
  }
}

// Whether devices on USB can be used.
void examine_usb(std::vector<peer::Finding>& findings) {
  const UsbLook look = look_at_usb(false);
  if (!look.problem.empty()) {
    findings.push_back({peer::FindingLevel::note,
                        look.problem + ": hands can only be simulated, or moved by a pointer",
                        "needed for a real device only"});
    return;
  }
  add_findings(look.devices, findings);
  if (look.devices.empty())
    findings.push_back({peer::FindingLevel::ok, "USB works; no haptic device is attached", ""});
}

// A serial port may have a haptic board, or any other device.
void examine_ports(std::vector<peer::Finding>& findings) {
  for (const AttachedDevice& line : peer::driver_ports()) {
    findings.push_back({line.problem.empty() ? peer::FindingLevel::ok : peer::FindingLevel::note,
                        "serial line " + line.name + ": " +
                            (line.problem.empty() ? "it can be opened" : line.problem),
                        line.remedy});
  }
}

peer::SceneFile scene_of(const DoctorOptions& options) {
  if (options.scene.empty()) return {};
  if (options.ipv6) throw UsageError("--ipv6: the scene sets the address family; remove --ipv6");
  try {
    return peer::load_scene_file(options.scene);
  } catch (const std::exception& error) {
    throw UsageError(error.what());
  }
}

peer::InterfaceChoice choose(const std::string& interface, bool ipv6) {
  try {
    return peer::choose_interface(interface, ipv6);
  } catch (const std::runtime_error& error) {
    throw EnvironmentError(error.what());
  }
}

int run_doctor(Arguments arguments, const Console& console) {
  DoctorOptions options;
  CommandLine line("doctor",
                   "Checks what a peer needs from this host, and reports problems with remedies.",
                   "reckon doctor scenes/two_hands.toml --iface eth0\n"
                   "reckon doctor --iface eth0 --json");
  line.word("SCENE", options.scene, false,
            "scene file: its interface, group, port and number of groups (default: "
            "239.192.1.0:3000 and 256 groups)");
  line.option("--iface", options.interface,
              "interface name, address or index (default: the scene's, else by score)");
  line.offer("--iface", kInterfaces);
  line.option("--groups", options.groups,
              "number of multicast groups joined at the same time (default: as in the scene)");
  line.flag("--ipv6", options.ipv6, "check IPv6 instead of IPv4");
  line.flag("--sealed", options.sealed,
            "check the port of a sealed exercise, one above (default: if the scene has a key)");
  line.flag("--json", options.json, "one JSON object per finding");
  if (const auto status = line.parse(arguments, console)) return *status;

  const peer::SceneFile scene = scene_of(options);
  const peer::HostNeeds needs = needs_of(options, scene);
  const peer::InterfaceChoice choice = choose(
      options.interface.empty() ? scene.network.iface : options.interface, needs.pool.base().is_v6);
  fmt::print(console.err, "{}", choice.explanation);
  std::vector<peer::Finding> findings = peer::examine_host(choice.interface, needs);
  findings.push_back(examine_waking());
  examine_usb(findings);
  examine_ports(findings);
  add_findings(look_beside_usb(), findings);

  for (const peer::Finding& finding : findings) {
    if (options.json)
      print_json(console.out, finding);
    else
      print_finding(console, finding);
  }
  print_summary(console.err, findings);
  const bool failed = std::any_of(findings.begin(), findings.end(), [](const peer::Finding& f) {
    return f.level == peer::FindingLevel::problem;
  });
  return exit_status(failed ? ExitCode::findings : ExitCode::good);
}

}  // namespace

namespace verb {

Verb doctor() { return verb_of(verb_row("doctor"), run_doctor); }

}  // namespace verb

}  // namespace reckon::tools

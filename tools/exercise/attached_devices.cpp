// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/attached_devices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::tools {
namespace {

using haptics::UsbDeviceSeen;

constexpr std::chrono::seconds kAskFor{2};

// A kind of device with a driver.
struct Kind {
  std::string_view driver, product, use;
  const haptics::UsbFacts& facts;
  std::unique_ptr<haptics::UsbDriver> (*make)();
};

const std::array<Kind, 2>& kinds() {
  static const std::array<Kind, 2> kAll{
      Kind{"falcon", "Novint Falcon",
           "3 axes, 8.9 N in a cube of 80 mm: reckon demo --device falcon", haptics::falcon_facts(),
           []() -> std::unique_ptr<haptics::UsbDriver> {
             return std::make_unique<haptics::FalconDriver>(haptics::FalconFirmware{});
           }},
      Kind{"polhem", "Polhem", "3 axes, 5 N in a cube of 100 mm: reckon demo --device polhem",
           haptics::polhem_facts(), []() -> std::unique_ptr<haptics::UsbDriver> {
             return std::make_unique<haptics::PolhemDriver>();
           }}};
  return kAll;
}

// Null: no driver of ours is for it.
const Kind* kind_of(const UsbDeviceSeen& device) {
  const auto found = std::ranges::find_if(kinds(), [&](const Kind& kind) {
    return device.vendor == kind.facts.vendor && device.product == kind.facts.product;
  });
  return found == kinds().end() ? nullptr : &*found;
}

AttachedDevice attached(const Kind& kind, const UsbDeviceSeen& seen,
                        std::span<const UsbProblem> problems, bool has_rule) {
  AttachedDevice device;
  device.driver = kind.driver;
  device.name = fmt::format("{}, /dev/bus/usb/{:03}/{:03}", kind.product, seen.bus, seen.address);
  device.use = kind.use;
  if (seen.is_open_to_us) {
    const auto found = std::ranges::find(problems, kind.driver, &UsbProblem::driver);
    if (found != problems.end()) device.problem = found->sentence;
  } else if (seen.is_denied) {
    device.problem = "this user may not open it";
    device.remedy =
        has_rule ? "plug it in again, for the rule is installed; over ssh it opens for the group "
                   "plugdev alone: sudo usermod -aG plugdev $USER, and log in again"
                 : "sudo reckon devices --install-rule, and plug it in again";
  } else {
    device.problem = "it cannot be opened: " + seen.problem;
    device.remedy = "plug it in again";
  }
  return device;
}

// Sets a device up without any force, within 2 s. @return why it shows none; empty: it can
std::string problem_of(const Kind& kind) {
  const peer::SteadyClock clock;
  haptics::UsbExchange exchange;
  haptics::UsbLoopOptions options;
  options.clock = [&clock] { return clock.now(); };
  haptics::UsbLoop loop(exchange, kind.make(), std::move(options));
  std::string last = fmt::format("{}: it sends no answer", kind.facts.name);
  for (const auto end = clock.now() + kAskFor; clock.now() < end;) {
    loop.step(std::chrono::milliseconds(1));
    const auto stage = loop.stage();
    if (stage == haptics::UsbStage::running) return {};
    for (std::string& sentence : loop.take_notices()) last = std::move(sentence);
    if (stage && stage != haptics::UsbStage::silent) break;  // set up, and no force yet
  }
  return last;
}

std::string rule_of(std::string_view subsystem, std::string_view attribute, const peer::UsbId& id) {
  return fmt::format(
      "SUBSYSTEM==\"{0}\", {1}{{idVendor}}==\"{2:04x}\", {1}{{idProduct}}==\"{3:04x}\", "
      "MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"\n",
      subsystem, attribute, id.vendor, id.product);
}

}  // namespace

std::string udev_rule(const std::vector<peer::UsbId>& undriven) {
  std::string rule = "# Devices that Reckon drives, for whoever sits at this host.\n";
  for (const Kind& kind : kinds())
    rule += rule_of("usb", "ATTR", {kind.facts.vendor, kind.facts.product});
  rule +=
      "# Event devices that give force feedback.\n"
      "SUBSYSTEM==\"input\", KERNEL==\"event*\", ATTRS{capabilities/ff}==\"*[1-9a-f]*\", "
      "TAG+=\"uaccess\"\n";
  if (!undriven.empty())
    rule += "# Wheels and sticks whose force feedback the kernel leaves alone.\n";
  for (const peer::UsbId& id : undriven) rule += rule_of("hidraw", "ATTRS", id);
  return rule;
}

std::string driver_names() {
  std::string names;
  for (const Kind& kind : kinds()) names += std::string(kind.driver) + ", ";
  return names + "evdev";
}

UsbLook judge_usb(const std::vector<UsbDeviceSeen>& seen, std::span<const UsbProblem> problems,
                  bool has_rule) {
  UsbLook look;
  if (seen.empty()) {
    look.problem =
        "no USB is visible, not even a hub: a container or a virtual machine needs "
        "/dev/bus/usb of its host";
  }
  for (const UsbDeviceSeen& device : seen) {
    if (const Kind* const kind = kind_of(device)) {
      look.devices.push_back(attached(*kind, device, problems, has_rule));
    } else {
      ++look.others;
    }
  }
  return look;
}

UsbLook look_at_usb(bool ask_them) {
  try {
    haptics::UsbContext context;
    const auto seen = haptics::usb_devices(
        context, [](const UsbDeviceSeen& device) { return kind_of(device) != nullptr; });
    std::vector<UsbProblem> problems;
    for (const Kind& kind : kinds()) {
      const bool is_here = std::ranges::any_of(seen, [&](const UsbDeviceSeen& device) {
        return kind_of(device) == &kind && device.is_open_to_us;
      });
      if (!ask_them || !is_here) continue;
      if (std::string problem = problem_of(kind); !problem.empty())
        problems.push_back({kind.driver, std::move(problem)});
    }
    return judge_usb(seen, problems,
                     std::filesystem::exists(std::filesystem::path(kRuleFolder) / kRuleFile));
  } catch (const std::exception& error) {
    UsbLook look;
    look.problem = error.what();
    return look;
  }
}

}  // namespace reckon::tools

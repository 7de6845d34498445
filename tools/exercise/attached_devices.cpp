// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/attached_devices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::tools {
namespace {

using haptics::UsbDeviceSeen;
using peer::Driver;

constexpr std::chrono::seconds kAskFor{2};

bool is_on_usb(const Driver& driver) { return driver.force != nullptr && driver.force->make; }

// Null: no driver of ours is for it.
const Driver* usb_driver_of(const UsbDeviceSeen& device) {
  const auto found = std::ranges::find_if(peer::drivers(), [&](const Driver* driver) {
    if (!is_on_usb(*driver)) return false;
    const haptics::UsbFacts& facts = driver->force->facts();
    return device.vendor == facts.vendor && device.product == facts.product;
  });
  return found == peer::drivers().end() ? nullptr : *found;
}

AttachedDevice attached(const Driver& driver, const UsbDeviceSeen& seen,
                        std::span<const UsbProblem> problems, bool has_rule) {
  AttachedDevice device;
  device.driver = driver.name;
  device.name =
      fmt::format("{}, /dev/bus/usb/{:03}/{:03}", driver.force->product, seen.bus, seen.address);
  device.use = driver.force->use;
  if (seen.is_open_to_us) {
    const auto found = std::ranges::find(problems, driver.name, &UsbProblem::driver);
    if (found != problems.end()) device.problem = found->sentence;
  } else if (seen.is_denied) {
    device.problem = "this user may not open it";
    device.remedy = has_rule
                        ? "the udev rule is installed: plug it in again; over ssh, only the group "
                          "plugdev may open it: sudo usermod -aG plugdev $USER, then log in again"
                        : "sudo reckon devices --install-rule, then plug it in again";
  } else {
    device.problem = "it cannot be opened: " + seen.problem;
    device.remedy = "plug it in again";
  }
  return device;
}

// Sets a device up without any force, within 2 s. @return why it shows none; empty: it can
std::string problem_of(const Driver& driver) {
  const peer::SteadyClock clock;
  haptics::UsbExchange exchange;
  haptics::UsbLoopOptions options;
  options.clock = [&clock] { return clock.now(); };
  haptics::UsbLoop loop(exchange, driver.force->make({}), std::move(options));
  std::string last = fmt::format("{}: it does not answer", driver.force->facts().name);
  for (const auto end = clock.now() + kAskFor; clock.now() < end;) {
    loop.step(std::chrono::milliseconds(1));
    const auto stage = loop.stage();
    if (stage == haptics::UsbStage::running) return {};
    for (std::string& sentence : loop.take_notices()) last = std::move(sentence);
    if (stage && stage != haptics::UsbStage::silent) break;  // set up, and no force yet
  }
  return last;
}

}  // namespace

std::string udev_rule() {
  std::string rule = "# Devices with a Reckon driver, for the user at this host.\n";
  for (const Driver* driver : peer::drivers()) {
    if (is_on_usb(*driver)) {
      const haptics::UsbFacts& facts = driver->force->facts();
      rule += peer::udev_line("usb", "ATTR", facts.vendor, facts.product);
    }
    if (driver->udev != nullptr) rule += driver->udev();
  }
  return rule;
}

UsbLook judge_usb(const std::vector<UsbDeviceSeen>& seen, std::span<const UsbProblem> problems,
                  bool has_rule) {
  UsbLook look;
  if (seen.empty()) {
    look.problem =
        "no USB is visible, not even a hub: give the container or virtual machine /dev/bus/usb of "
        "its host";
  }
  for (const UsbDeviceSeen& device : seen) {
    if (const Driver* const driver = usb_driver_of(device)) {
      look.devices.push_back(attached(*driver, device, problems, has_rule));
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
        context, [](const UsbDeviceSeen& device) { return usb_driver_of(device) != nullptr; });
    std::vector<UsbProblem> problems;
    for (const Driver* driver : peer::drivers()) {
      const bool is_here = std::ranges::any_of(seen, [&](const UsbDeviceSeen& device) {
        return usb_driver_of(device) == driver && device.is_open_to_us;
      });
      if (!ask_them || !is_here) continue;
      if (std::string problem = problem_of(*driver); !problem.empty())
        problems.push_back({driver->name, std::move(problem)});
    }
    return judge_usb(seen, problems,
                     std::filesystem::exists(std::filesystem::path(kRuleFolder) / kRuleFile));
  } catch (const std::exception& error) {
    UsbLook look;
    look.problem = error.what();
    return look;
  }
}

std::vector<AttachedDevice> look_beside_usb() {
  std::vector<AttachedDevice> all;
  for (const Driver* driver : peer::drivers())
    if (driver->find != nullptr) std::ranges::move(driver->find(), std::back_inserter(all));
  return all;
}

}  // namespace reckon::tools

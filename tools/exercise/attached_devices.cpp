// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/attached_devices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::tools {
namespace {

using haptics::UsbDeviceSeen;

constexpr std::chrono::seconds kAskFor{2};

bool is_falcon(const UsbDeviceSeen& device) {
  return device.vendor == haptics::falcon_facts().vendor &&
         device.product == haptics::falcon_facts().product;
}

// Of what the driver says, what keeps forces away.
std::string problem_in(const std::vector<std::string>& said) {
  for (const std::string& sentence : said) {
    const bool is_good = sentence.find("ready") != std::string::npos ||
                         sentence.find("an exchange takes") != std::string::npos ||
                         sentence.find("firmware loaded") != std::string::npos;
    if (!is_good) return sentence;
  }
  return {};
}

AttachedDevice falcon_of(const UsbDeviceSeen& seen, const std::vector<std::string>& said) {
  AttachedDevice device;
  device.driver = "falcon";
  device.name = fmt::format("Novint Falcon, /dev/bus/usb/{:03}/{:03}", seen.bus, seen.address);
  device.use = "3 axes, 8.9 N in a cube of 80 mm: reckon demo --device falcon";
  if (seen.is_open_to_us) {
    device.problem = problem_in(said);
  } else if (seen.is_denied) {
    device.problem = "this user may not open it";
    device.remedy = "sudo reckon devices --install-rule, and plug it in again";
  } else {
    device.problem = "it cannot be opened: " + seen.problem;
    device.remedy = "plug it in again";
  }
  return device;
}

}  // namespace

std::string_view udev_rule() noexcept {
  return "# Devices that Reckon drives, for whoever sits at this host.\n"
         "SUBSYSTEM==\"usb\", ATTR{idVendor}==\"0403\", ATTR{idProduct}==\"cb48\", "
         "MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"\n";
}

UsbLook judge_usb(const std::vector<UsbDeviceSeen>& seen, const std::vector<std::string>& said) {
  UsbLook look;
  if (seen.empty()) {
    look.problem =
        "no USB is visible, not even a hub: a container or a virtual machine needs "
        "/dev/bus/usb of its host";
  }
  for (const UsbDeviceSeen& device : seen) {
    if (is_falcon(device)) {
      look.devices.push_back(falcon_of(device, said));
    } else {
      ++look.others;
    }
  }
  return look;
}

std::vector<std::string> ask_falcon() {
  const peer::SteadyClock clock;
  haptics::UsbExchange exchange;
  haptics::UsbLoopOptions options;
  options.clock = [&clock] { return clock.now(); };
  haptics::UsbLoop loop(exchange,
                        std::make_unique<haptics::FalconDriver>(haptics::FalconFirmware{}),
                        std::move(options));
  const auto end = clock.now() + kAskFor;
  while (clock.now() < end) {
    loop.step(std::chrono::milliseconds(1));
    if (auto said = loop.take_notices(); !said.empty()) return said;
  }
  return {"Falcon: it says nothing"};
}

UsbLook look_at_usb(bool ask) {
  try {
    haptics::UsbContext context;
    const auto seen = haptics::usb_devices(context, haptics::falcon_facts().vendor,
                                           haptics::falcon_facts().product);
    const bool asks = ask && std::ranges::any_of(seen, [](const UsbDeviceSeen& device) {
                        return is_falcon(device) && device.is_open_to_us;
                      });
    return judge_usb(seen, asks ? ask_falcon() : std::vector<std::string>());
  } catch (const std::exception& error) {
    UsbLook look;
    look.problem = error.what();
    return look;
  }
}

}  // namespace reckon::tools

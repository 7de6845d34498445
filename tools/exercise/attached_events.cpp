// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/attached_events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "reckon/haptics/hid/hid_events.hpp"

namespace reckon::tools {
namespace {

constexpr std::uint16_t kBoardVendor = 0x1209, kBoardProduct = 0xFFB0;  // OpenFFBoard

AttachedDevice judged(const haptics::EventDeviceSeen& seen) {
  const haptics::EventFacts& facts = seen.facts;
  AttachedDevice device;
  device.driver = "evdev";
  device.name = fmt::format("{}, {}", facts.name, seen.path);
  const int axes = facts.axes[1] ? 2 : 1;
  device.use = fmt::format(
      "renders walls by itself along {}: driver = \"evdev\" in a [[device]] that states travel, "
      "full_force, full_stiffness and max_stiffness",
      axes == 2 ? "two axes" : "an axis, event_axes = 1");
  if (!seen.remedy.empty()) {
    device.use = "has force feedback; what it renders is known once it can be opened";
    device.problem = "this user may not open it";
    device.remedy = seen.remedy;
  } else if (!seen.problem.empty()) {
    device.use = "has force feedback; what it renders is known once it can be opened";
    device.problem = "it cannot be opened: " + seen.problem;
    device.remedy = "plug it in again";
  } else if (const std::string fault = haptics::fault_of(facts, axes); !fault.empty()) {
    device.use = "has force feedback, of another kind";
    device.problem = fault;
  }
  return device;
}

}  // namespace

std::vector<AttachedDevice> judge_events(const std::vector<haptics::EventDeviceSeen>& seen,
                                         const std::vector<haptics::UsbDeviceSeen>& usb) {
  std::vector<AttachedDevice> devices;
  for (const haptics::EventDeviceSeen& one : seen) devices.push_back(judged(one));
  const auto board = std::ranges::find_if(usb, [](const haptics::UsbDeviceSeen& device) {
    return device.vendor == kBoardVendor && device.product == kBoardProduct;
  });
  const bool is_driven = std::ranges::any_of(seen, [](const haptics::EventDeviceSeen& one) {
    return one.facts.name.find("FFBoard") != std::string::npos;
  });
  if (board != usb.end() && !is_driven) {
    AttachedDevice device;
    device.driver = "evdev";
    device.name = fmt::format("OpenFFBoard, /dev/bus/usb/{:03}/{:03}", board->bus, board->address);
    device.use = "renders walls by itself, once it is a game controller";
    device.problem = "it has no interface of the class PID";
    device.remedy =
        "choose a game controller (main class FFB wheel or joystick) in the board's own "
        "configurator";
    devices.push_back(std::move(device));
  }
  return devices;
}

std::vector<peer::UsbId> undriven_devices() {
  std::vector<peer::UsbId> found;
  for (const haptics::HidSeen& seen : haptics::undriven_devices(*haptics::kernel_hid_calls())) {
    const peer::UsbId id{seen.vendor, seen.product};
    if (std::ranges::find(found, id) == found.end()) found.push_back(id);
  }
  return found;
}

std::vector<AttachedDevice> look_at_events() {
  std::vector<haptics::UsbDeviceSeen> usb;
  try {
    haptics::UsbContext context;
    usb = haptics::usb_devices(context, [](const haptics::UsbDeviceSeen&) { return false; });
  } catch (const std::exception&) {
    // Without USB there is no board to look for.
  }
  const auto calls = haptics::force_feedback_calls();
  return judge_events(haptics::event_devices(*calls), usb);
}

}  // namespace reckon::tools

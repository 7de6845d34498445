// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/drivers/evdev.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/threads/threaded_device.hpp"

namespace reckon::peer {
namespace {

constexpr std::uint16_t kBoardVendor = 0x1209, kBoardProduct = 0xFFB0;  // OpenFFBoard

AttachedDevice judged(const haptics::EventDeviceSeen& seen) {
  const haptics::EventFacts& facts = seen.facts;
  AttachedDevice device;
  device.driver = "evdev";
  device.name = fmt::format("{}, {}", facts.name, seen.path);
  const int axes = facts.axes[1] ? 2 : 1;
  device.use = fmt::format(
      "renders walls itself along {}: write driver = \"evdev\" in a [[device]] with travel, "
      "full_force, full_stiffness and max_stiffness",
      axes == 2 ? "two axes" : "one axis, with event_axes = 1");
  if (!seen.remedy.empty()) {
    device.use = "has force feedback; its effects are unknown until it can be opened";
    device.problem = "this user may not open it";
    device.remedy = seen.remedy;
  } else if (!seen.problem.empty()) {
    device.use = "has force feedback; its effects are unknown until it can be opened";
    device.problem = "it cannot be opened: " + seen.problem;
    device.remedy = "plug it in again";
  } else if (const std::string fault = haptics::fault_of(facts, axes); !fault.empty()) {
    device.use = "has force feedback that Reckon cannot use";
    device.problem = fault;
  }
  return device;
}

// Scans this host. Requests no force.
std::vector<AttachedDevice> find_events() {
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

std::string udev_of_this_host() {
  std::vector<EventUsbId> undriven;
  for (const haptics::HidSeen& seen : haptics::undriven_devices(*haptics::kernel_hid_calls())) {
    const EventUsbId id{seen.vendor, seen.product};
    if (std::ranges::find(undriven, id) == undriven.end()) undriven.push_back(id);
  }
  return evdev_udev(undriven);
}

std::string event_fault_of(const DeviceConfig& device) {
  if (device.axes != 3) return "'event_axes' gives the axes of an event device: remove 'axes'";
  if (device.scale != 1.0 || device.left_handed || device.clutch_button >= 0)
    return "an event device renders walls in the coordinates of its handle: remove 'scale', "
           "'left_handed' and 'clutch_button'";
  try {
    static_cast<void>(haptics::evdev_limits(evdev_settings_of(device)));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

OpenedDevice open_events(const DeviceConfig& device, const DeviceOpening& opening) {
  const haptics::EvdevSettings settings = evdev_settings_of(device);
  return {evdev_device(opening.clock, settings),
          fmt::format(
              "evdev: a new wall starts farther away than a hand at {:.3g} m/s moves in {:.2g} ms; "
              "contacts with others act along its axes, and do not move a hand that does not press",
              settings.max_speed, 1e3 * pdu::to_seconds(settings.chain))};
}

// The device without its kernel interface.
std::shared_ptr<haptics::HapticDevice> felt_events(const DeviceConfig& device) {
  struct Unplugged {
    explicit Unplugged(const haptics::DeviceLimits& limits) : device(exchange, limits) {}
    haptics::EvdevExchange exchange;
    haptics::EvdevDevice device;
  };
  const auto unplugged =
      std::make_shared<Unplugged>(haptics::evdev_limits(evdev_settings_of(device)));
  return {unplugged, &unplugged->device};
}

DriverKey stated(std::string_view key, std::string_view unit, double least, double most,
                 std::string_view help) {
  return {.key = key,
          .standard = 0.0,
          .unit = unit,
          .least = least,
          .most = most,
          .has_default = false,
          .help = help};
}

std::vector<DriverKey> event_keys() {
  return {
      {.key = "event",
       .standard = std::string(),
       .help = "of evdev: its path (/dev/input/event7, /dev/hidraw0) or a part of its name; when "
               "absent, the first device with force feedback"},
      {.key = "event_axes",
       .standard = std::uint32_t{2},
       .least = 1,
       .most = 2,
       .help = "of evdev: 1: ABS_X, as x of the device; 2: also ABS_Y, as y"},
      stated("travel", "m", 0.01, 10,
             "of evdev: handle travel from one end of an axis to the other; no device reports "
             "it"),
      stated("full_force", "N", 0.1, 1e3,
             "of evdev: force at the handle at the greatest level; no device reports it"),
      stated("full_stiffness", "N/m", 1, 1e6,
             "of evdev: stiffness at the handle of a spring with the greatest coefficient; no "
             "device reports it"),
  };
}

}  // namespace

std::unique_ptr<RealDevice> evdev_device(const Clock& clock, const haptics::EvdevSettings& settings,
                                         std::unique_ptr<haptics::EventCalls> calls) {
  return std::make_unique<
      ThreadedDevice<haptics::EvdevExchange, haptics::EvdevDevice, haptics::EvdevLoop>>(
      clock, "rk-evdev", haptics::evdev_limits(settings), settings, std::move(calls),
      [&clock] { return clock.now(); });
}

haptics::EvdevSettings evdev_settings_of(const DeviceConfig& device) {
  haptics::EvdevSettings settings;
  settings.event = driver_value<std::string>(device, "event");
  settings.axes = static_cast<int>(driver_value<std::uint32_t>(device, "event_axes"));
  settings.scale = {driver_value<double>(device, "travel"),
                    driver_value<double>(device, "full_force"),
                    driver_value<double>(device, "full_stiffness")};
  settings.max_force = device.max_force;
  settings.max_stiffness = device.max_stiffness;
  settings.max_speed = device.max_speed;
  if (device.delay_samples > 0) settings.chain = device.delay_samples * device.period;
  return settings;
}

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
  if (board == usb.end() || is_driven) return devices;
  devices.push_back(
      {.driver = "evdev",
       .name = fmt::format("OpenFFBoard, /dev/bus/usb/{:03}/{:03}", board->bus, board->address),
       .use = "renders walls itself when configured as a game controller",
       .problem = "it has no HID interface of class PID",
       .remedy = "select a game controller (main class FFB wheel or joystick) in the board's "
                 "configurator"});
  return devices;
}

std::string evdev_udev(const std::vector<EventUsbId>& undriven) {
  std::string rule =
      "# Event devices with force feedback.\nSUBSYSTEM==\"input\", KERNEL==\"event*\", "
      "ATTRS{capabilities/ff}==\"*[1-9a-f]*\", TAG+=\"uaccess\"\n";
  if (!undriven.empty())
    rule += "# Wheels and sticks with force feedback that the kernel does not drive.\n";
  for (const EventUsbId& id : undriven) rule += udev_line("hidraw", "ATTRS", id.vendor, id.product);
  return rule;
}

const Driver& evdev_driver() {
  static constexpr SpringSide kSprings{
      felt_events, [](const DeviceConfig& device) { return evdev_settings_of(device).chain; }};
  static const DevicePlace kPlace{
      "a wheel or stick (/dev/input/event7, /dev/hidraw0)",
      [](const std::string& text) {
        return text.starts_with("/dev/input/") || text.starts_with("/dev/hidraw");
      },
      [](DeviceConfig& device, const std::string& text) { device.driver_values["event"] = text; }};
  static const Driver kDriver{.name = "evdev",
                              .article = "a force feedback device of Linux",
                              .summary = "a wheel or stick with force feedback",
                              .is_cooled = true,
                              .keys = event_keys(),
                              .fault = event_fault_of,
                              .stands_in = true,
                              .springs = &kSprings,
                              .place = &kPlace,
                              .holder =
                                  [](const DeviceConfig& device) {
                                    const auto& event = driver_value<std::string>(device, "event");
                                    return fmt::format("a person, by {} with force feedback",
                                                       event.empty() ? "the first device" : event);
                                  },
                              .find = find_events,
                              .udev = udev_of_this_host,
                              .open = open_events};
  return kDriver;
}

}  // namespace reckon::peer

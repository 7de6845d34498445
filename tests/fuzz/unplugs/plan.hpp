// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a seed of the storm of unplugs draws: a device, its line, and what befalls them when. Each
// fault can be left out without changing the others.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace reckon::fuzz::unplugs {

using std::chrono::nanoseconds;

enum class DeviceKind : std::uint8_t { falcon, polhem, serial_board, event_device, hid_device };
inline constexpr std::size_t kDeviceKinds = 5;

/// Whether it renders springs by itself: it knows its place, and shows walls later.
[[nodiscard]] constexpr bool renders_springs(DeviceKind kind) noexcept {
  return kind >= DeviceKind::event_device;
}

enum class FaultKind : std::uint8_t {
  // Of the plug.
  unplug,
  loose,         ///< the line fails for a while before it is gone, as a hub tells it
  bounce,        ///< out and in, several times within milliseconds
  other_device,  ///< unplugged; another one is in its place for a while
  denied,        ///< unplugged; plugged in again, it may not be opened for a while
  // Of the program.
  end_program,  ///< the thread's part ends, and begins anew
  freeze,       ///< the thread stands still for a while
  silent_servo,
  // Of the line and the device.
  reset_port,  ///< its hub calls off what is under way
  errors,      ///< some transfers or calls end with an error
  stall,       ///< the next transfer to it is refused
  cut,         ///< the next transfer to it is cut short
  hang,        ///< nothing that is sent to it ends, or goes out, for a while
  mute,        ///< no reports for a while
  damage,      ///< its next reports are damaged, so that it can be seen
  loss,        ///< octets are lost both ways for a while
  bunches,     ///< what it sends comes in bunches, or octet by octet
  restart,     ///< its program begins anew
  busy,        ///< calls are to be made again, for a while
  slow,        ///< the next calls take their time
  refusal,     ///< effects are refused, or not played, or not erased
  drop,        ///< the kernel drops events
};
inline constexpr std::size_t kFaultKinds = 22;

/// Whether its plug is pulled.
[[nodiscard]] constexpr bool is_unplug(FaultKind kind) noexcept {
  return kind <= FaultKind::denied;
}
/// Those that befall a kind of device; the first is a plain unplug.
[[nodiscard]] std::span<const FaultKind> faults_of(DeviceKind kind) noexcept;

/// What the device's thread is at when the fault comes.
enum class Phase : std::uint8_t {
  any,         ///< whatever is left of the fault before
  opening,     ///< a call to the kernel, counted from when it begins to look for the device
  setting_up,  ///< from when the device was opened
  homing,
  running,
};
inline constexpr std::size_t kPhases = 5;

struct Fault {
  FaultKind kind = FaultKind::unplug;
  Phase phase = Phase::running;
  unsigned call = 0;         ///< opening only: before the answer to this one
  nanoseconds after{};       ///< in its phase
  nanoseconds lasts{};       ///< until it is plugged in again, or over
  bool loses_power = false;  ///< unplugged: what it forgets without power
  bool stays = false;        ///< the hand stays in the wall
  unsigned number = 0;       ///< of errors, bounces, reports, calls; of milliseconds with failures
  double depth = 0.01;       ///< [m], of the hand in the wall when it is taken up again
};

struct Line {
  bool splits = false;  ///< reports come in pieces
  double out_at = 0;    ///< [ms], when in a frame of USB the device takes a transfer; or its way
  double in_at = 0.5;   ///< [ms], when in a frame of USB its report comes; or its way

  friend bool operator==(const Line&, const Line&) = default;
};

struct Plan {
  std::uint64_t seed = 0;
  DeviceKind device = DeviceKind::falcon;
  Line line;
  std::vector<Fault> faults;
};

/// Unplugs and other faults of a seed.
inline constexpr std::size_t kFaults = 100;

[[nodiscard]] Plan plan_of(std::uint64_t seed);
/// The same with reports in one piece, half a millisecond on their way.
[[nodiscard]] Plan calmed(Plan plan);
[[nodiscard]] std::string text_of(const Plan& plan);
[[nodiscard]] std::string text_of(const Fault& fault);

}  // namespace reckon::fuzz::unplugs

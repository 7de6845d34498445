// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The random plan of a seed of the unplug simulation: a device, its line, and its faults with their
// times. Each fault can be omitted without changing the others.
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

/// Whether the device renders springs by itself: it knows its position, and shows walls later.
[[nodiscard]] constexpr bool renders_springs(DeviceKind kind) noexcept {
  return kind >= DeviceKind::event_device;
}

enum class FaultKind : std::uint8_t {
  // Faults of the plug.
  unplug,
  loose,         ///< the line fails for a while before it disappears, as a hub reports it
  bounce,        ///< out and in, several times within milliseconds
  other_device,  ///< unplugged; another device is in its place for a while
  denied,        ///< unplugged; plugged in again, it may not be opened for a while
  // Faults of the program.
  end_program,  ///< the thread's loop ends and starts again
  freeze,       ///< the thread pauses for a while
  silent_servo,
  // Faults of the line and the device.
  reset_port,  ///< its hub cancels the transfers under way
  errors,      ///< some transfers or calls end with an error
  stall,       ///< the next transfer to it is refused
  cut,         ///< the next transfer to it is cut short
  hang,        ///< no transfer to it ends, or leaves, for a while
  mute,        ///< no reports for a while
  damage,      ///< its next reports are detectably damaged
  loss,        ///< octets are lost in both directions for a while
  bunches,     ///< its data arrives in bunches, or octet by octet
  restart,     ///< its firmware restarts
  busy,        ///< calls have to be repeated, for a while
  slow,        ///< the next calls are slow
  refusal,     ///< effects are refused, or not played, or not erased
  drop,        ///< the kernel drops events
};
inline constexpr std::size_t kFaultKinds = 22;

/// Whether its plug is pulled.
[[nodiscard]] constexpr bool is_unplug(FaultKind kind) noexcept {
  return kind <= FaultKind::denied;
}
/// The faults of a kind of device; the first is a plain unplug.
[[nodiscard]] std::span<const FaultKind> faults_of(DeviceKind kind) noexcept;

/// The state of the device's thread when the fault occurs.
enum class Phase : std::uint8_t {
  any,         ///< whatever follows the fault before
  opening,     ///< at a call to the kernel, counted from the start of the search for the device
  setting_up,  ///< counted from the opening of the device
  homing,
  running,
};
inline constexpr std::size_t kPhases = 5;

struct Fault {
  FaultKind kind = FaultKind::unplug;
  Phase phase = Phase::running;
  unsigned call = 0;         ///< opening only: before the answer to this call
  nanoseconds after{};       ///< time in its phase
  nanoseconds lasts{};       ///< until it is plugged in again, or over
  bool loses_power = false;  ///< unplugged: loses the state that needs power
  bool stays = false;        ///< the hand stays in the wall
  unsigned number = 0;       ///< of errors, bounces, reports, calls; or ms with failures
  double depth = 0.01;       ///< [m], of the hand in the wall when the device is used again
};

struct Line {
  bool splits = false;  ///< reports come in pieces
  double out_at = 0;    ///< [ms], when in a USB frame the device takes a transfer; or its latency
  double in_at = 0.5;   ///< [ms], when in a USB frame its report comes; or its latency

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
/// The same plan with whole reports and half a millisecond of latency.
[[nodiscard]] Plan calmed(Plan plan);
[[nodiscard]] std::string text_of(const Plan& plan);
[[nodiscard]] std::string text_of(const Fault& fault);

}  // namespace reckon::fuzz::unplugs

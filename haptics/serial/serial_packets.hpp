// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What frames on the line of a serial board say. Numbers have their low octet first.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "reckon/haptics/serial/serial_frames.hpp"

namespace reckon::haptics {

inline constexpr std::uint8_t kSerialVersion = 1;
inline constexpr std::size_t kSerialAxes = 3;  ///< of a board that is driven, at most

/// First octet of what a frame carries.
enum class SerialKind : std::uint8_t {
  ask = 0x01,       ///< to the board: say what you are, and drop your force
  force = 0x02,     ///< to the board: hold this
  greeting = 0x81,  ///< what it is
  report = 0x82,    ///< where it is, and which force it holds
};

/// One axis, as a board greets.
struct SerialAxis {
  std::uint8_t direction = 0;     ///< along which axis of frame D: 0 x, 1 y, 2 z
  std::int32_t nm_per_count = 0;  ///< [nm], negative: greater counts are less far along D
  std::uint16_t most_force = 0;   ///< [mN] that it can hold

  friend bool operator==(const SerialAxis&, const SerialAxis&) = default;
};

/// From the board, for each time that it is asked.
struct SerialGreeting {
  std::uint8_t version = kSerialVersion;
  std::uint16_t answers = 0;  ///< the number of the question
  std::uint8_t axes = 0;      ///< how many, of which `axis` has the first three
  std::uint8_t watchdog = 0;  ///< [ms] after which it lets go without a frame
  std::uint16_t period = 0;   ///< [us] between its reports
  std::array<SerialAxis, kSerialAxes> axis{};
  std::array<char, 33> name{};  ///< printable ASCII, ends with a zero

  friend bool operator==(const SerialGreeting&, const SerialGreeting&) = default;
};

/// From the board, at its own rate: an instant at which it read its encoders, and at no other it
/// takes up another force.
struct SerialReport {
  std::uint16_t sequence = 0;               ///< one more in each report
  std::uint32_t stamp = 0;                  ///< [us] of its own clock
  std::optional<std::uint16_t> until = {};  ///< number of the force held until then; none: none
  std::optional<std::uint16_t> from = {};   ///< number of the force held from then on
  std::uint8_t let_go = 0;                  ///< how often it did so by itself, modulo 16
  bool homed = true;                        ///< its counts are places
  std::uint8_t buttons = 0;
  std::array<std::int32_t, kSerialAxes> counts{};

  friend bool operator==(const SerialReport&, const SerialReport&) = default;
};

/// To the board.
struct SerialForce {
  std::uint16_t number = 0;
  std::array<std::int16_t, kSerialAxes> force{};  ///< [mN], towards greater counts
};

/// @return nothing where the frame is none, or not of this length
[[nodiscard]] std::optional<SerialGreeting> serial_greeting(
    std::span<const std::uint8_t> carried) noexcept;
/// Of a greeting of any version. @return nothing where the frame is none
[[nodiscard]] std::optional<std::uint8_t> serial_version(
    std::span<const std::uint8_t> carried) noexcept;
/// @param axes of the board, 1 to 3
[[nodiscard]] std::optional<SerialReport> serial_report(std::span<const std::uint8_t> carried,
                                                        std::size_t axes) noexcept;

/// @param number that the greeting repeats
[[nodiscard]] SerialFrame ask_frame(std::uint16_t number) noexcept;
/// @param axes of the board, 1 to 3
[[nodiscard]] SerialFrame frame_of(const SerialForce& force, std::size_t axes) noexcept;

/// Why no forces can be shown with a board that greets so, as a sentence; empty: they can.
/// @param max_force [N], that the servo may ask for  @param resolution [m], that it relies on
[[nodiscard]] std::string refusal_of(const SerialGreeting& greeting, double max_force,
                                     double resolution);

}  // namespace reckon::haptics

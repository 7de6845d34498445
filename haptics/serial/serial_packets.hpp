// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Payloads of the frames of a serial board. Numbers are little-endian.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "reckon/haptics/serial/serial_frames.hpp"

namespace reckon::haptics {

inline constexpr std::uint8_t kSerialVersion = 1;
inline constexpr std::size_t kSerialAxes = 3;  ///< greatest number of axes of a supported board

/// First octet of a payload.
enum class SerialKind : std::uint8_t {
  ask = 0x01,       ///< to the board: identify yourself, and set zero force
  force = 0x02,     ///< to the board: hold this force
  greeting = 0x81,  ///< from the board: its identification
  report = 0x82,    ///< from the board: its position, and the force that it holds
};

/// One axis of a greeting.
struct SerialAxis {
  std::uint8_t direction = 0;     ///< axis of frame D: 0 x, 1 y, 2 z
  std::int32_t nm_per_count = 0;  ///< [nm]; negative: counts grow against the axis of D
  std::uint16_t most_force = 0;   ///< [mN], greatest force that it can hold

  friend bool operator==(const SerialAxis&, const SerialAxis&) = default;
};

/// The board's answer to each ask frame.
struct SerialGreeting {
  std::uint8_t version = kSerialVersion;
  std::uint16_t answers = 0;  ///< number of the ask frame
  std::uint8_t axes = 0;      ///< number of axes; `axis` holds the first three
  std::uint8_t watchdog = 0;  ///< [ms] without a frame until it sets zero force
  std::uint16_t period = 0;   ///< [us] between reports
  std::array<SerialAxis, kSerialAxes> axis{};
  std::array<char, 33> name{};  ///< printable ASCII, zero-terminated

  friend bool operator==(const SerialGreeting&, const SerialGreeting&) = default;
};

/// From the board, at its own rate: a sample of its encoders. The board changes its force only at
/// the instant of a sample.
struct SerialReport {
  std::uint16_t sequence = 0;  ///< incremented with each report
  std::uint32_t stamp = 0;     ///< [us] of the board's clock
  std::optional<std::uint16_t> until =
      {};  ///< number of the force held until then; std::nullopt: none
  std::optional<std::uint16_t> from =
      {};                        ///< number of the force held from then on; std::nullopt: none
  std::uint8_t force_drops = 0;  ///< how often its watchdog has set zero force, modulo 16
  bool homed = true;             ///< its counts are valid positions
  std::uint8_t buttons = 0;
  std::array<std::int32_t, kSerialAxes> counts{};

  friend bool operator==(const SerialReport&, const SerialReport&) = default;
};

/// A force for the board.
struct SerialForce {
  std::uint16_t number = 0;
  std::array<std::int16_t, kSerialAxes> force{};  ///< [mN], towards greater counts
};

/// @return std::nullopt: another kind, or malformed
[[nodiscard]] std::optional<SerialGreeting> serial_greeting(
    std::span<const std::uint8_t> carried) noexcept;
/// Version of a greeting of any version. @return std::nullopt: not a greeting
[[nodiscard]] std::optional<std::uint8_t> serial_version(
    std::span<const std::uint8_t> carried) noexcept;
/// @param axes of the board, 1 to 3
[[nodiscard]] std::optional<SerialReport> serial_report(std::span<const std::uint8_t> carried,
                                                        std::size_t axes) noexcept;

/// @param number, which the greeting repeats
[[nodiscard]] SerialFrame ask_frame(std::uint16_t number) noexcept;
/// @param axes of the board, 1 to 3
[[nodiscard]] SerialFrame frame_of(const SerialForce& force, std::size_t axes) noexcept;

/// Why a board with this greeting cannot be used, as a sentence; empty: it can.
/// @param max_force [N], greatest force of the servo @param resolution [m], on which the servo
/// relies
[[nodiscard]] std::string refusal_of(const SerialGreeting& greeting, double max_force,
                                     double resolution);

}  // namespace reckon::haptics

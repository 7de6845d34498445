// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The Entity States of a capture by columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/capture/datagram_source.hpp"

namespace reckon::python {

/// One row for each Entity State, in the order of the capture; vectors have three numbers a row.
struct StateColumns {
  std::vector<double> time;                ///< arrival [s since 1970 UTC]
  std::vector<std::uint64_t> frame;        ///< of the capture, from 1
  std::vector<std::uint8_t> exercise_id;   ///< of the header
  std::vector<std::uint32_t> timestamp;    ///< of the header, as on the wire
  std::vector<std::uint16_t> entity_id;    ///< site, application, entity
  std::vector<std::uint8_t> force_id;      ///< 1 friendly, 2 opposing, 3 neutral
  std::vector<std::uint16_t> entity_type;  ///< kind, domain, country, category .. extra: 7
  std::vector<double> location;            ///< W [m]
  std::vector<float> orientation;          ///< psi, theta, phi [rad]
  std::vector<float> linear_velocity;      ///< W, or B for DRM 6 to 9 [m/s]
  std::vector<float> linear_acceleration;  ///< the same axes [m/s^2]
  std::vector<float> angular_velocity;     ///< B [rad/s]
  std::vector<std::uint8_t> algorithm;     ///< dead-reckoning model, 0 to 9
  std::vector<std::uint32_t> appearance;   ///< as on the wire
  std::vector<char> marking;               ///< 11 characters a row
  std::size_t pdus = 0;                    ///< of all types
  std::size_t damaged = 0;                 ///< that could not be read
  std::string problem;                     ///< why the file ended early; else empty

  void add(const peer::SourceDatagram& datagram, const pdu::EntityState& state);
  void reserve(std::size_t rows);
};

/// Reads a capture file to its end. Any thread.
/// @throws std::runtime_error with the path and the reason if it is no capture
[[nodiscard]] StateColumns read_state_columns(const std::string& path);

}  // namespace reckon::python

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Positions and orientations on the wire as people read them: latitude, longitude and height on
// WGS84, heading, pitch and roll.
#pragma once

#include <optional>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// A place on WGS84.
struct Geodetic {
  double latitude_deg = 0.0;   ///< north, -90 to 90
  double longitude_deg = 0.0;  ///< east, -180 to 180
  double height = 0.0;         ///< above the ellipsoid [m]
};

/// From geocentric coordinates, within 1e-9 degrees and 1 mm up to 10,000 km above the ground. No
/// value for numbers that are not finite, or for a position nearer than 1000 km to the earth's
/// centre, which cannot be a real one.
[[nodiscard]] std::optional<Geodetic> geodetic_from(const WorldCoordinates& location) noexcept;

/// An orientation against the horizon.
struct Attitude {
  double heading_deg = 0.0;  ///< of the body's x axis, from north by east, 0 to 360
  double pitch_deg = 0.0;    ///< of the body's x axis, up, -90 to 90
  double roll_deg = 0.0;     ///< right side down, -180 to 180
};

/// From the angles on the wire at a place. No value for angles that are not finite.
[[nodiscard]] std::optional<Attitude> attitude_from(const EulerAngles& orientation,
                                                    const Geodetic& place) noexcept;

}  // namespace reckon::pdu

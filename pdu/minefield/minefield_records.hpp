// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Records that the minefield PDUs share.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/codec/records.hpp"

namespace reckon::pdu {

/// A point of a perimeter, in the axes of the minefield [m].
struct Vector2Float {
  float x = 0.0F;
  float y = 0.0F;
};

/// One number of a mine, in the columns of Minefield Data.
struct MineReal {
  float value = 0.0F;
};
struct MineWord {
  std::uint16_t value = 0;
};
struct MineOctet {
  std::uint8_t value = 0;
};

/// A sensor that detects mines.
struct SensorType {
  std::uint16_t sensor_type = 0;
};

}  // namespace reckon::pdu

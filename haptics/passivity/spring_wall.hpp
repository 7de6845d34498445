// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force model of a coefficient device: a spring on either side along each of its axes.
#pragma once

#include <array>
#include <cstddef>

namespace reckon::haptics {

/// Direction of a spring's force.
enum class WallSide : std::size_t {
  below,  ///< towards +, on a handle below its surface
  above,  ///< towards -, on a handle above its surface
};

/// A spring of one side, along one axis of a device. It conserves energy.
struct SpringWall {
  double at = 0.0;         ///< [m], position of its surface
  double stiffness = 0.0;  ///< [N/m] >= 0; 0: no wall
  double most = 0.0;       ///< [N] >= 0, greatest force

  friend bool operator==(const SpringWall&, const SpringWall&) = default;
};

/// All walls of a device. A missing wall has no stiffness.
struct SpringModel {
  static constexpr std::size_t kAxes = 2, kSides = 2;
  std::array<std::array<SpringWall, kSides>, kAxes> walls{};  ///< by axis, then by WallSide

  [[nodiscard]] SpringWall& wall(std::size_t axis, WallSide side) noexcept {
    return walls[axis][static_cast<std::size_t>(side)];
  }
  [[nodiscard]] const SpringWall& wall(std::size_t axis, WallSide side) const noexcept {
    return walls[axis][static_cast<std::size_t>(side)];
  }
  friend bool operator==(const SpringModel&, const SpringModel&) = default;
};

/// Depth of a handle at `x` [m] in the wall [m]; 0 outside.
[[nodiscard]] double depth_in(const SpringWall& wall, WallSide side, double x) noexcept;
/// Force of the wall along the axis [N].
[[nodiscard]] double force_of(const SpringWall& wall, WallSide side, double x) noexcept;
/// Energy that the wall returns until the handle has left it [J].
[[nodiscard]] double stored_in(const SpringWall& wall, WallSide side, double x) noexcept;

/// A range of positions of a handle [m].
struct PlaceRange {
  double from = 0.0, to = 0.0;
};

/// Greatest increase of the stored energy, at any of these positions, if one wall replaces another
/// [J]. Negative if it falls at all of them. Exact within rounding; about 50 ns.
[[nodiscard]] double worst_rise(const SpringWall& old, const SpringWall& next, WallSide side,
                                PlaceRange places) noexcept;

}  // namespace reckon::haptics

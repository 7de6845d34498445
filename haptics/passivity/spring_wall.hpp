// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force model that a device renders by itself: along each of its axes a spring on either side.
#pragma once

#include <array>
#include <cstddef>

namespace reckon::haptics {

/// Which way a spring pushes.
enum class WallSide : std::size_t {
  below,  ///< towards +, a handle that is below its place
  above,  ///< towards -, a handle that is above its place
};

/// A spring of one side, along one axis of a device. It stores what is put in and gives back no
/// more.
struct SpringWall {
  double at = 0.0;         ///< [m], where it begins
  double stiffness = 0.0;  ///< [N/m] >= 0; 0: there is none
  double most = 0.0;       ///< [N] >= 0, its force grows no further

  friend bool operator==(const SpringWall&, const SpringWall&) = default;
};

/// All that a device is told. Walls that are not there have no stiffness.
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

/// [m], how far a handle at `x` [m] is in the wall; 0 outside.
[[nodiscard]] double depth_in(const SpringWall& wall, WallSide side, double x) noexcept;
/// [N], along the axis.
[[nodiscard]] double force_of(const SpringWall& wall, WallSide side, double x) noexcept;
/// [J], that the wall gives back until the handle has left it.
[[nodiscard]] double stored_in(const SpringWall& wall, WallSide side, double x) noexcept;

/// Places of a handle [m].
struct PlaceRange {
  double from = 0.0, to = 0.0;
};

/// The most that the stored energy rises, at any of these places, where a wall becomes another [J].
/// Below 0 where it falls at all of them. Exact but for rounding; about 50 ns.
[[nodiscard]] double worst_rise(const SpringWall& old, const SpringWall& next, WallSide side,
                                PlaceRange places) noexcept;

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Something besides the hands of this peer that presses bodies.
#pragma once

#include <chrono>

namespace reckon::haptics {

/// Steps at the start of each period, before the hands of this peer. Servo thread.
class BodyGuest {
 public:
  BodyGuest() = default;
  BodyGuest(const BodyGuest&) = delete;
  BodyGuest& operator=(const BodyGuest&) = delete;
  virtual ~BodyGuest() = default;

  /// The world has advanced to `now`: its works are those of the last period.
  /// @param frozen the bodies stand still
  virtual void step(std::chrono::nanoseconds now, bool frozen) noexcept = 0;
  /// Whether the next step would press a body, or has news.
  [[nodiscard]] virtual bool is_pending() noexcept = 0;
  /// Takes energy out of what it may put into bodies [J]; negative: adds it there.
  /// @return the energy taken
  virtual double take(double energy) noexcept = 0;
};

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Response of a material to a tap: a decaying oscillation, which distinguishes wood, rubber and
// metal. A scene file sets it with `vibration = {..}` of an object.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "reckon/haptics/effects/effect_hooks.hpp"
#include "reckon/haptics/effects/effect_parameter.hpp"

namespace reckon::haptics {

/// Parameters of a material (Okamura, Cutkosky and Dennerlein 2001: aluminium 300 Hz, 90/s; wood
/// 100 Hz, 80/s; rubber 30 Hz, 60/s).
struct Ringing {
  double amplitude = 1.0;    ///< [N s/m], force over approach speed
  double frequency = 100.0;  ///< [Hz]
  double decay = 80.0;       ///< [1/s]
};

/// F = amplitude v e^(-decay t) sin(2 pi frequency t) along the normal, with the impact speed v of
/// the device and the time t since the impact. It never pulls, and fades as the energy of the tap
/// allows.
class TapVibration : public CountedEffect<TapVibration> {
 public:
  using Parameters = Ringing;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "tap_vibration";
  static constexpr std::string_view kKey = "vibration";
  static constexpr std::string_view kCost = "a sine and an exponential while it rings";
  static constexpr std::array<EffectParameter<Ringing>, 3> kParameters{{
      {"amplitude", "N s/m", &Ringing::amplitude, 0.0, 100.0, 1.0,
       "Force of the oscillation per m/s of the tap; higher rings louder."},
      {"frequency", "Hz", &Ringing::frequency, 1.0, 300.0, 100.0,
       "Of the oscillation; higher feels harder, rubber is below 50 Hz and metal above 200 Hz."},
      {"decay", "1/s", &Ringing::decay, 10.0, 1000.0, 80.0, "Decay rate; higher is shorter."},
  }};

  /// @throws std::invalid_argument when a value is out of the table's range.
  explicit TapVibration(const Ringing& ringing) : ringing_(ringing) {
    check_parameters(kParameters, ringing);
  }

  /// Hook: the oscillation [N].
  [[nodiscard]] Eigen::Vector3d force(const EffectContact& contact) noexcept {
    if (!contact.in_contact) return Eigen::Vector3d::Zero();
    if (contact.object->began) {
      speed_ = std::max(-contact.relative().dot(contact.normal), 0.0);
      time_ = 0.0;
    }
    time_ += contact.dt;
    const double left = std::exp(-ringing_.decay * time_);
    if (!(left > kOver)) return Eigen::Vector3d::Zero();
    const double wave = std::sin(2.0 * std::numbers::pi * ringing_.frequency * time_);
    return ringing_.amplitude * speed_ * left * wave * contact.normal;
  }

  /// Hook: it reserves no damping.
  [[nodiscard]] double damping() const noexcept { return 0.0; }

  [[nodiscard]] const Ringing& parameters() const noexcept { return ringing_; }

 private:
  static constexpr double kOver = 1e-4;

  Ringing ringing_;
  double speed_ = 0.0;  // of the tap [m/s]
  double time_ = 0.0;   // since then [s]
};

}  // namespace reckon::haptics

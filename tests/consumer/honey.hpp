// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An effect of an external program: a surface whose drag grows with the pressing force.
#pragma once

#include "reckon/haptics/effects/effect_custom.hpp"

struct HoneyValues {
  double strength = 1.0;  // [s/m]
};

class Honey : public reckon::haptics::CountedEffect<Honey> {
 public:
  using Parameters = HoneyValues;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "honey";
  static constexpr std::string_view kKey = "honey";  // in scene files
  static constexpr std::string_view kCost = "a few multiplications";
  static constexpr std::array<reckon::haptics::EffectParameter<HoneyValues>, 1> kParameters{{
      {"strength", "s/m", &HoneyValues::strength, 0.0, 100.0, 1.0,
       "Drag for each newton of pressure and m/s; higher is stickier."},
  }};

  explicit Honey(const HoneyValues& values) : values_(values) {
    reckon::haptics::check_parameters(kParameters, values);
  }

  Eigen::Vector3d force(const reckon::haptics::EffectContact& contact) noexcept {
    if (!contact.in_contact) return Eigen::Vector3d::Zero();
    return -values_.strength * contact.normal_force() * contact.slip();
  }
  double damping() const noexcept { return 0.0; }  // no fixed coefficient to reserve
  const HoneyValues& parameters() const noexcept { return values_; }

 private:
  HoneyValues values_;
};

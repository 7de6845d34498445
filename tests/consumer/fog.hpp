// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An effect of an external program: air whose drag grows with the speed of a hand.
#pragma once

#include "reckon/haptics/regions/region_custom.hpp"

struct FogValues {
  double thickness = 1.0;  // [N s2/m2]
};

class Fog : public reckon::haptics::CountedEffect<Fog> {
 public:
  using Parameters = FogValues;
  static constexpr bool kInsideOnly = true;
  static constexpr std::string_view kName = "fog";
  static constexpr std::string_view kKey = "fog";  // in scene files
  static constexpr std::string_view kCost = "one square root";
  static constexpr std::array<reckon::haptics::EffectParameter<FogValues>, 1> kParameters{{
      {"thickness", "N s2/m2", &FogValues::thickness, 0.0, 1000.0, 1.0,
       "Drag for the square of each m/s; higher is thicker."},
  }};

  explicit Fog(const FogValues& values) : values_(values) {
    reckon::haptics::check_parameters(kParameters, values);
  }

  Eigen::Vector3d force(const reckon::haptics::RegionPoint& point) noexcept {
    return -values_.thickness * point.velocity.norm() * point.velocity;
  }
  const FogValues& parameters() const noexcept { return values_; }

 private:
  FogValues values_;
};

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A larger threshold for fast entities: a delay of d already causes an error of |v| d at a viewer,
// and a smaller error is not worth its packets.
#pragma once

#include <array>
#include <string_view>

#include "reckon/deadreckon/sending/pose_error.hpp"
#include "reckon/deadreckon/sending/rule_parameter.hpp"

namespace reckon::deadreckon {

/// The threshold increases by the distance that the entity covers at its true speed in
/// `speed_allowance` seconds.
struct VelocityAware {
  struct Parameters {
    double speed_allowance = 0;  ///< [s], >= 0
  };
  static constexpr std::string_view kName = "velocity_aware";
  static constexpr std::string_view kMeaning = "distance, larger for fast entities";
  static constexpr std::array<RuleParameter<Parameters>, 1> kParameters{{
      {"speed_allowance", "s", &Parameters::speed_allowance, 0, 10, 0,
       "seconds of speed on top of `position`"},
  }};

  [[nodiscard]] static double share(const PoseError& error, double position,
                                    const Parameters& parameters) noexcept {
    return error.position.norm() /
           (position + parameters.speed_allowance * error.true_velocity.norm());
  }
};

}  // namespace reckon::deadreckon

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A larger threshold for a distant nearest viewer: errors below the eye's resolution do not count.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/deadreckon/sending/pose_error.hpp"
#include "reckon/deadreckon/sending/rule_parameter.hpp"

namespace reckon::deadreckon {

/// The threshold is the length that covers `visual_angle` at `viewer_distance`, but at least the
/// position threshold.
struct SeenFrom {
  struct Parameters {
    double viewer_distance = 0;  ///< Of the nearest viewer [m], >= 0.
    /// [rad], resolution of the eye. Default 2.9e-4, one minute of arc.
    double visual_angle = 2.908882086657216e-4;
  };
  static constexpr std::string_view kName = "seen_from";
  static constexpr std::string_view kMeaning = "the resolution of the eye at the viewer's distance";
  static constexpr std::array<RuleParameter<Parameters>, 1> kParameters{{
      {"viewer_distance", "m", &Parameters::viewer_distance, 0, 1e6, 0,
       "distance of the nearest viewer, whose eye resolves one minute of arc"},
  }};

  [[nodiscard]] static double share(const PoseError& error, double position,
                                    const Parameters& parameters) noexcept {
    return error.position.norm() /
           std::max(position, parameters.visual_angle * parameters.viewer_distance);
  }
};

}  // namespace reckon::deadreckon

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The default rule: the position error may reach the threshold in any direction, a sphere.
#pragma once

#include <string_view>

#include "reckon/deadreckon/sending/pose_error.hpp"
#include "reckon/deadreckon/sending/rule_parameter.hpp"

namespace reckon::deadreckon {

struct TrueDistance {
  static constexpr std::string_view kName = "true_distance";
  static constexpr std::string_view kMeaning = "distance, a sphere (the default)";
  using Parameters = NoRuleParameters;
  static constexpr auto& kParameters = kNoRuleParameters;

  [[nodiscard]] static double share(const PoseError& error, double position,
                                    const Parameters&) noexcept {
    return error.position.norm() / position;
  }
};

}  // namespace reckon::deadreckon

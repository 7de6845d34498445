// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The threshold on each axis separately, a cube, as in several other programs. Towards its corners
// the error is up to 73 % above the threshold. It serves for comparison.
#pragma once

#include <string_view>

#include "reckon/deadreckon/sending/pose_error.hpp"
#include "reckon/deadreckon/sending/rule_parameter.hpp"

namespace reckon::deadreckon {

struct PerAxis {
  static constexpr std::string_view kName = "per_axis";
  static constexpr std::string_view kMeaning = "each axis separately, a cube: for comparison";
  using Parameters = NoRuleParameters;
  static constexpr auto& kParameters = kNoRuleParameters;

  [[nodiscard]] static double share(const PoseError& error, double position,
                                    const Parameters&) noexcept {
    return error.position.lpNorm<Eigen::Infinity>() / position;
  }
};

}  // namespace reckon::deadreckon

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of rules by which an owner holds its peers' error of position against the thresholds. A
// new one is a header in send_rules/ and a row here.
#pragma once

#include <array>
#include <string_view>

#include "reckon/deadreckon/sending/per_axis.hpp"
#include "reckon/deadreckon/sending/seen_from.hpp"
#include "reckon/deadreckon/sending/true_distance.hpp"
#include "reckon/deadreckon/sending/velocity_aware.hpp"

namespace reckon::deadreckon {

struct SendRule {
  std::string_view name;
  std::string_view meaning;
  /// The error as a share of what is allowed: above 1, or not a number, is sent.
  double (*share)(const PoseError&, const Thresholds&) noexcept;
};

inline constexpr std::array<SendRule, 4> kSendRules{{
    {"true_distance", "distance, a sphere (the default)", true_distance},
    {"per_axis", "each axis by itself, a cube: for comparison", per_axis},
    {"velocity_aware", "distance, and more for what is fast", velocity_aware},
    {"seen_from", "what the eye resolves at the viewer's distance", seen_from},
}};

inline constexpr const SendRule& kDefaultSendRule = kSendRules.front();

}  // namespace reckon::deadreckon

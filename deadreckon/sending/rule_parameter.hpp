// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One row of a send rule's parameter table. Scene files, their error messages and the documentation
// read these rows, so that a new parameter of a rule needs no code outside its header.
#pragma once

#include <array>
#include <string_view>

namespace reckon::deadreckon {

/// A parameter of a rule; its values are members of the struct P.
template <class P>
struct RuleParameter {
  std::string_view key;   ///< in scene files
  std::string_view unit;  ///< SI, "" for a pure number
  double P::*field;
  double minimum;
  double maximum;
  double default_value;   ///< 0: a scene that names the rule must give a greater value
  std::string_view help;  ///< description for a row of a table
};

/// Parameters of a rule that only uses the threshold.
struct NoRuleParameters {};
inline constexpr std::array<RuleParameter<NoRuleParameters>, 0> kNoRuleParameters{};

}  // namespace reckon::deadreckon

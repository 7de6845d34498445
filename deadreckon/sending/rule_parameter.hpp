// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One row of a send rule's parameter table. Scene files, their error messages and the documentation
// read these rows, so that a rule with a quantity of its own needs no code outside its header.
#pragma once

#include <array>
#include <string_view>

namespace reckon::deadreckon {

/// A parameter of a rule whose values lie in the struct P.
template <class P>
struct RuleParameter {
  std::string_view key;   ///< in scene files
  std::string_view unit;  ///< SI, "" for a pure number
  double P::*field;
  double minimum;
  double maximum;
  double default_value;   ///< 0: a scene that names the rule has to give more
  std::string_view help;  ///< what it is, as a row of a table says it
};

/// A rule that looks at the threshold alone.
struct NoRuleParameters {};
inline constexpr std::array<RuleParameter<NoRuleParameters>, 0> kNoRuleParameters{};

}  // namespace reckon::deadreckon

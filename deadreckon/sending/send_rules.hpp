// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of rules that compare the position error at peers with the thresholds. A new rule is a
// header here and a row in SendRules: Thresholds and scene files take its parameters from its own
// table.
#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "reckon/deadreckon/sending/per_axis.hpp"
#include "reckon/deadreckon/sending/pose_error.hpp"
#include "reckon/deadreckon/sending/seen_from.hpp"
#include "reckon/deadreckon/sending/true_distance.hpp"
#include "reckon/deadreckon/sending/velocity_aware.hpp"

namespace reckon::deadreckon {

// One row a rule; the first is the default.
// clang-format off
using SendRules = std::tuple<
    TrueDistance,
    PerAxis,
    VelocityAware,
    SeenFrom>;
// clang-format on

/// Calls f(std::type_identity<Rule>{}) once per rule, in the order of the list.
constexpr void for_each_send_rule(auto&& f) {
  [&]<class... Rules>(std::type_identity<std::tuple<Rules...>>) {
    (f(std::type_identity<Rules>{}), ...);
  }(std::type_identity<SendRules>{});
}

/// The values of one rule's parameters.
template <class Rule>
struct RuleValues {
  typename Rule::Parameters values;
};
template <class List>
struct AllRuleValues;
template <class... Rules>
struct AllRuleValues<std::tuple<Rules...>> {
  using Type = std::tuple<RuleValues<Rules>...>;
};

/// The greatest errors at peers before an update is sent. The only accuracy settings of a user:
/// smaller values mean more packets.
struct Thresholds {
  double position = 1.0;  ///< True distance [m], a sphere; the standard's default. 1e-4 and up.
  double angle = 0.05235987755982989;  ///< True angle [rad]; the standard's default, 3 degrees.
  double force = 0.1;                  ///< [N], at touched places.
  /// Allowed force error as a share of the true force, 0 to 1: people notice 0.07 to 0.1. The
  /// larger of both force thresholds counts. Default 0: only `force`.
  double weber = 0;

  /// Parameters of a rule besides `position`: of<SeenFrom>().viewer_distance.
  template <class Rule>
  [[nodiscard]] constexpr typename Rule::Parameters& of() noexcept {
    return std::get<RuleValues<Rule>>(of_rules).values;
  }
  template <class Rule>
  [[nodiscard]] constexpr const typename Rule::Parameters& of() const noexcept {
    return std::get<RuleValues<Rule>>(of_rules).values;
  }

  AllRuleValues<SendRules>::Type of_rules{};
};

/// Distance [m] from which fingertips separate two points: a threshold for objects that are touched
/// without being held.
inline constexpr double kFingertipResolution = 2.5e-3;

/// A rule as a value.
struct SendRule {
  std::string_view name;
  std::string_view meaning;
  /// Error divided by the allowed error: an update is sent for a value above 1 or NaN.
  double (*share)(const PoseError&, const Thresholds&) noexcept;
};

/// The rules of the list.
inline constexpr auto kSendRules = []<class... Rules>(std::type_identity<std::tuple<Rules...>>) {
  return std::array{SendRule{Rules::kName, Rules::kMeaning,
                             [](const PoseError& error, const Thresholds& thresholds) noexcept {
                               return Rules::share(error, thresholds.position,
                                                   thresholds.template of<Rules>());
                             }}...};
}(std::type_identity<SendRules>{});

inline constexpr const SendRule& kDefaultSendRule = kSendRules.front();

}  // namespace reckon::deadreckon

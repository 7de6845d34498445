// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Series of the thesis' scenes as curves, and what is read from them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "reckon/bench/analysis/thesis_scenes.hpp"
#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

/// What a figure shows of a scene.
enum class Quantity { force, velocity };

[[nodiscard]] std::string axis_title(Quantity quantity);  ///< "force [N]"
[[nodiscard]] std::string unit_of(Quantity quantity);
[[nodiscard]] std::string reading_name(SpringReading reading);  ///< "K with T"

[[nodiscard]] double value_of(const SceneSample& sample, Quantity quantity);

[[nodiscard]] FigureCurve curve_of(std::string name, const std::vector<SceneSample>& series,
                                   Quantity quantity);
/// @param user 0 or 1
[[nodiscard]] FigureCurve curve_of(std::string name,
                                   const std::vector<std::array<SceneSample, 2>>& series,
                                   std::size_t user, Quantity quantity);

/// Without curves, over `duration` [s].
[[nodiscard]] FigurePanel panel_over_time(std::string title, Quantity quantity, double duration);

/// The value of greatest magnitude, without its sign; 0 of an empty curve.
[[nodiscard]] double greatest(const FigureCurve& curve);

/// From when on the curve stays within `share` of its last value [s].
[[nodiscard]] double settled_after(const FigureCurve& curve, double share);

}  // namespace reckon::bench

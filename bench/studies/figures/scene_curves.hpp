// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time series of the thesis' scenes as curves, and the numbers that are read from them.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "reckon/bench/analysis/thesis_scenes.hpp"
#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

/// The quantity of a scene that a figure shows.
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

/// An empty panel over `duration` [s].
[[nodiscard]] FigurePanel panel_over_time(std::string title, Quantity quantity, double duration);

/// The greatest magnitude; 0 for an empty curve.
[[nodiscard]] double greatest(const FigureCurve& curve);

/// Time from which the curve stays within `share` of its last value [s].
[[nodiscard]] double settled_after(const FigureCurve& curve, double share);

}  // namespace reckon::bench

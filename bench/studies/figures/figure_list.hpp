// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of the thesis' figures of chapters 3 to 5: experiments, which are computed, and
// drawings.
#pragma once

#include <span>
#include <string_view>

#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

struct FigureKind {
  std::string_view name;   ///< number in the thesis: "3.5"
  std::string_view title;  ///< in one line
  Figure (*make)();        ///< computes or draws it, within a second or two
  bool is_drawing = false;
};

/// In the order of the thesis.
[[nodiscard]] std::span<const FigureKind> figure_kinds();

}  // namespace reckon::bench

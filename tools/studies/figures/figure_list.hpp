// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of the thesis' figures of chapters 3 and 4: experiments, which are made, and drawings,
// which are not.
#pragma once

#include <span>
#include <string_view>

#include "reckon/tools/studies/figures/figure.hpp"

namespace reckon::tools {

struct FigureKind {
  std::string_view name;   ///< number in the thesis: "3.5"
  std::string_view title;  ///< in one line
  /// Computes it, in a second or two. Null for a drawing.
  Figure (*make)();

  [[nodiscard]] bool is_drawing() const { return make == nullptr; }
};

/// In the order of the thesis.
[[nodiscard]] std::span<const FigureKind> figure_kinds();

}  // namespace reckon::tools

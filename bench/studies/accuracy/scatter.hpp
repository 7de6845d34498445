// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The picture of a study of accuracy: what it costs against how far off it is.
#pragma once

#include <string>

#include "reckon/bench/studies/accuracy/study.hpp"

namespace reckon::bench {

/// The shapes of the marks, once in a page before any picture.
[[nodiscard]] std::string scatter_marks();

/// Octets/s against p99 of the position error, both axes logarithmic, as an SVG element for a page.
/// Colour and shape say the model; pale is dominated. The line joins the settings with the least
/// error for their octets. What is below the axis lies on its end. Classes: of the page's style.
[[nodiscard]] std::string scatter_svg(const AccuracyResult& result);

/// Colours and shapes with the names of the models that take part.
[[nodiscard]] std::string scatter_legend(const AccuracyResult& result);

}  // namespace reckon::bench

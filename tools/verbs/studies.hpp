// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The verbs of the program `reckon-bench`, as in the help of both programs. `reckon` lists them too
// and starts that program, as git does with its own. It is built and installed beside `reckon`.
#pragma once

#include <string_view>

namespace reckon::tools {

struct StudyVerb {
  std::string_view name;
  std::string_view summary;  ///< one line
};

inline constexpr StudyVerb kTuneVerb{"tune", "find the model and threshold for recorded motion"};
inline constexpr StudyVerb kBenchVerb{
    "bench", "studies: cost of accuracy, latency of a touch, stability, scaling"};
inline constexpr StudyVerb kFiguresVerb{"figures", "compute the figures of the thesis"};
inline constexpr StudyVerb kZWidthVerb{
    "zwidth", "compute the stiffness and damping that a device can render"};

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The verbs of the program `reckon-bench`, as the help of both programs has them. `reckon` lists
// them too and starts it, as git starts its own; it is built and installed beside `reckon`.
#pragma once

#include <string_view>

namespace reckon::tools {

struct StudyVerb {
  std::string_view name;
  std::string_view summary;  ///< one line
};

inline constexpr StudyVerb kTuneVerb{"tune", "say which model and threshold suit recorded motion"};
inline constexpr StudyVerb kBenchVerb{
    "bench", "the studies: what accuracy costs, how long a touch takes, what stays calm"};
inline constexpr StudyVerb kFiguresVerb{"figures", "make the figures of the thesis anew"};
inline constexpr StudyVerb kZWidthVerb{"zwidth",
                                       "say which stiffness and damping a device can show"};

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon bench`: the studies, each a word behind it.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

/// Exit status 1 where the default misses the bar of `--circle`.
int run_bench(Arguments arguments, const Console& console);

}  // namespace reckon::tools

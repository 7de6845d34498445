// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon tune FILE`: threshold and model against bandwidth and error, for recorded motion or
// force.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_tune(Arguments arguments, const Console& console);

}  // namespace reckon::tools

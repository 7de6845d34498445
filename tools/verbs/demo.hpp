// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon demo`: peers in one process, on loopback or in simulated time; ends with what it cost.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

/// The verb; see `reckon demo --help`.
int run_demo(Arguments arguments, const Console& console);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon scene`: check scene files, explain what a servo will run for one, list the keys.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_scene(Arguments arguments, const Console& console);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon info FILE`: what a capture holds.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_info(Arguments arguments, const Console& console);

}  // namespace reckon::tools

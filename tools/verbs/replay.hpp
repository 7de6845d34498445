// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon replay FILE`: a capture back onto the network.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_replay(Arguments arguments, const Console& console);

}  // namespace reckon::tools

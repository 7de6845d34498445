// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon peer SCENE`: one peer on a LAN.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

/// The verb; see `reckon peer --help`.
int run_peer(Arguments arguments, const Console& console);

}  // namespace reckon::tools

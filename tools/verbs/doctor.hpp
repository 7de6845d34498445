// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon doctor`: what is wrong with this host for a peer, and how to fix it.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_doctor(Arguments arguments, const Console& console);

}  // namespace reckon::tools

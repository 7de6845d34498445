// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon cut IN OUT`: a part of a capture as a new one.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_cut(Arguments arguments, const Console& console);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon completion SHELL`: a completion script made from the verb table and each verb's own
// flags.
#pragma once

#include "reckon/tools/program.hpp"

namespace reckon::tools {

int run_completion(Arguments arguments, const Console& console);

}  // namespace reckon::tools

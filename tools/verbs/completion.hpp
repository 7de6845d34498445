// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon completion SHELL`: a completion script from the verb table and each verb's flags.
#pragma once

#include <span>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// `verbs`: the list in program.cpp.
int run_completion(std::span<const Verb> verbs, Arguments arguments, const Console& console);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Starts the program of a verb, as git does with its own.
#pragma once

#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::tools {

/// Runs `PROGRAM VERB ARGUMENTS`. It replaces this process if `console` has this process's streams,
/// so that signals, terminal and exit status belong to the program.
/// @return its exit status
/// @throws EnvironmentError with the remedy if the program is missing. In a build folder it first
/// offers, on a terminal, to build it.
int start_program(const VerbRow& row, Arguments arguments, const Console& console);

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Starts the program that a verb is part of, as git does with its own.
#pragma once

#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::tools {

/// Runs `PROGRAM VERB ARGUMENTS`, in place of this process where the streams are its own, so that
/// signals, terminal and exit status are those of the program.
/// @return its exit status @throws EnvironmentError if the program is not there, with the remedy
int start_program(const VerbRow& row, Arguments arguments, const Console& console);

}  // namespace reckon::tools

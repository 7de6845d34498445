// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A program whose verbs read scene files, tables and meshes.
#pragma once

#include "reckon/tools/command_line/verb_program.hpp"

namespace reckon::tools {

/// Runs a verb. Reports on stderr each second which file is being read. A faulty table is wrong
/// usage.
[[nodiscard]] int run_reading(const Verb& verb, Arguments arguments, const Console& console);

/// run_verb_program(), where each verb is run by run_reading().
[[nodiscard]] int run_reading_program(VerbProgram program, Arguments arguments,
                                      const Console& console) noexcept;

}  // namespace reckon::tools

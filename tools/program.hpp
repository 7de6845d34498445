// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program `reckon`: starts the program of each verb. Its own verbs are only help and
// completion. THE list of verbs is in command_line/verb_rows.hpp; a new verb is one file in verbs/
// and a row of that list.
#pragma once

#include <functional>
#include <span>

#include "reckon/tools/command_line/verb_rows.hpp"
#include "reckon/tools/verbs/program_start.hpp"

namespace reckon::tools {

/// All verbs, in the order of help.
[[nodiscard]] std::span<const Verb> verbs();

/// start_program(), or a substitute in a test.
using StartVerb =
    std::function<int(const VerbRow& row, Arguments arguments, const Console& console)>;

/// Runs `reckon ARGUMENTS` (without the program's name) and returns the exit status. Never throws.
///
///   const std::array<std::string_view, 2> arguments{"info", "exercise.pcapng"};
///   return run_program(arguments, Console{});
[[nodiscard]] int run_program(Arguments arguments, const Console& console,
                              const StartVerb& start = start_program) noexcept;

}  // namespace reckon::tools

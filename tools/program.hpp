// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program `reckon`: THE list of its verbs, in program.cpp, and the function that runs one. A
// new verb is one file in verbs/ and one row of the list. Help, manual page, completion and the
// suggestion for a mistyped verb use the list.
#pragma once

#include <span>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// All verbs, in the order in which help lists them.
[[nodiscard]] std::span<const Verb> verbs();

/// Runs `reckon ARGUMENTS` (without the program's name) and returns the exit status. Never throws.
///
///   const std::array<std::string_view, 2> arguments{"info", "exercise.pcapng"};
///   return run_program(arguments, Console{});
[[nodiscard]] int run_program(Arguments arguments, const Console& console) noexcept;

}  // namespace reckon::tools

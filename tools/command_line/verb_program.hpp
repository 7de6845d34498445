// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A program whose first word is a verb. It finds the verb, runs it, and turns exceptions into one
// line on stderr and an exit status. `reckon` is one, `reckon-bench` another.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

struct VerbProgram {
  std::string_view name;   ///< as typed
  std::string_view title;  ///< first line of the overview
  std::span<const Verb> verbs;
  /// Runs words that do not begin with a verb, or returns nothing if it cannot; null: never.
  std::function<std::optional<int>(Arguments arguments, const Console& console)> run_other = {};
  /// Runs a verb; null: calls its `run`.
  int (*around)(const Verb& verb, Arguments arguments, const Console& console) = nullptr;
};

/// The verb with this name; null if there is none.
[[nodiscard]] const Verb* find_verb(const VerbProgram& program, std::string_view name);

/// Usage, a line for each verb, and the meanings of the exit statuses.
void print_overview(const VerbProgram& program, std::FILE* out);

/// Reports on stderr that there is no such verb, with the nearest one. @return the exit status
int refuse_verb(const VerbProgram& program, std::string_view name, const Console& console);

/// Runs `PROGRAM ARGUMENTS` (without the program's name) and returns the exit status. Never throws.
[[nodiscard]] int run_verb_program(const VerbProgram& program, Arguments arguments,
                                   const Console& console) noexcept;

/// main() of such a program: sets up signals, colour and streams of this process.
/// @param run  as run_verb_program() of one program
[[nodiscard]] int run_process(int argc, char** argv,
                              int (*run)(Arguments arguments, const Console& console) noexcept);

}  // namespace reckon::tools

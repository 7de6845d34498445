// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect_program.hpp"

#include <vector>

#include "reckon/tools/command_line/reading_program.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::tools {

std::span<const Verb> inspect_verbs() {
  static const std::vector<Verb> kVerbs = own_verbs<kInspectProgram>();
  return kVerbs;
}

int run_inspect_program(Arguments arguments, const Console& console) noexcept {
  return run_reading_program(
      {"reckon-inspect",
       "Verbs of Reckon for captures: `reckon inspect` and similar verbs start it.",
       inspect_verbs()},
      arguments, console);
}

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/program.hpp"

#include <vector>

#include "reckon/tools/command_line/reading_program.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::bench {

std::span<const tools::Verb> verbs() {
  static const std::vector<tools::Verb> kVerbs = tools::own_verbs<tools::kBenchProgram>();
  return kVerbs;
}

int run_program(tools::Arguments arguments, const tools::Console& console) noexcept {
  return tools::run_reading_program(
      {"reckon-bench", "Studies of Reckon: `reckon bench` and similar verbs start it.", verbs()},
      arguments, console);
}

}  // namespace reckon::bench

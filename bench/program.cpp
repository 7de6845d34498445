// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/program.hpp"

#include <array>

#include "reckon/tools/command_line/reading_program.hpp"

namespace reckon::bench {
namespace verb {

// One for each file of verbs/.
tools::Verb bench();
tools::Verb figures();
tools::Verb tune();
tools::Verb zwidth();

}  // namespace verb

std::span<const tools::Verb> verbs() {
  static const std::array kVerbs{verb::bench(), verb::figures(), verb::tune(), verb::zwidth()};
  return kVerbs;
}

int run_program(tools::Arguments arguments, const tools::Console& console) noexcept {
  return tools::run_reading_program(
      {"reckon-bench", "The studies of Reckon: `reckon bench` and its like start them.", verbs()},
      arguments, console);
}

}  // namespace reckon::bench

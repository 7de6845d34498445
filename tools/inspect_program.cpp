// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect_program.hpp"

#include <array>

#include "reckon/tools/command_line/reading_program.hpp"

namespace reckon::tools {
namespace verb {

Verb inspect();
Verb record();
Verb replay();
Verb info();
Verb cut();

}  // namespace verb

std::span<const Verb> inspect_verbs() {
  static const std::array kVerbs{verb::inspect(), verb::record(), verb::replay(), verb::info(),
                                 verb::cut()};
  return kVerbs;
}

int run_inspect_program(Arguments arguments, const Console& console) noexcept {
  return run_reading_program(
      {"reckon-inspect", "The captures of Reckon: `reckon inspect` and its like start it.",
       inspect_verbs()},
      arguments, console);
}

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/peer_program.hpp"

#include <array>

#include "reckon/tools/command_line/reading_program.hpp"

namespace reckon::tools {
namespace verb {

Verb demo();
Verb peer();
Verb view();
Verb scene();
Verb key();
Verb devices();
Verb doctor();

}  // namespace verb

std::span<const Verb> peer_verbs() {
  static const std::array kVerbs{verb::demo(), verb::peer(),    verb::view(),  verb::scene(),
                                 verb::key(),  verb::devices(), verb::doctor()};
  return kVerbs;
}

int run_peer_program(Arguments arguments, const Console& console) noexcept {
  return run_reading_program(
      {"reckon-peer", "The peers of Reckon: `reckon demo` and its like start them.", peer_verbs()},
      arguments, console);
}

}  // namespace reckon::tools

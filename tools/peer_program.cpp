// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/peer_program.hpp"

#include <vector>

#include "reckon/tools/command_line/reading_program.hpp"
#include "reckon/tools/command_line/verb_rows.hpp"

namespace reckon::tools {

std::span<const Verb> peer_verbs() {
  static const std::vector<Verb> kVerbs = own_verbs<kPeerProgram>();
  return kVerbs;
}

int run_peer_program(Arguments arguments, const Console& console) noexcept {
  return run_reading_program(
      {"reckon-peer", "Verbs of Reckon for peers: `reckon demo` and similar verbs start it.",
       peer_verbs()},
      arguments, console);
}

}  // namespace reckon::tools

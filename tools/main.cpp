// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program `reckon`: passes its arguments and streams to the program of the verb.
#include "reckon/tools/command_line/verb_program.hpp"
#include "reckon/tools/program.hpp"

int main(int argc, char** argv) {
  return reckon::tools::run_process(
      argc, argv,
      [](reckon::tools::Arguments arguments, const reckon::tools::Console& console) noexcept {
        return reckon::tools::run_program(arguments, console);
      });
}

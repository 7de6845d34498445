// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program `reckon-bench`: passes its arguments and streams to the verbs.
#include "reckon/bench/program.hpp"
#include "reckon/tools/command_line/verb_program.hpp"

int main(int argc, char** argv) {
  return reckon::tools::run_process(argc, argv, reckon::bench::run_program);
}

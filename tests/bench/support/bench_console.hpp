// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs `reckon-bench` in process and keeps its output.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "reckon/bench/program.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::test {

/// Runs `reckon-bench ARGUMENTS`; `stop` is set as by Ctrl-C.
inline ProgramResult run_bench(const std::vector<std::string>& arguments,
                               const std::atomic<bool>* stop = nullptr) {
  return run_captured(bench::run_program, arguments, stop);
}

}  // namespace reckon::test

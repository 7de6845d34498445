// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Runs `reckon-bench` in process and keeps what it wrote.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "reckon/bench/program.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::test {

/// Runs `reckon-bench ARGUMENTS`; `stop` as Ctrl-C would set it.
inline ProgramResult run_bench(const std::vector<std::string>& arguments,
                               const std::atomic<bool>* stop = nullptr) {
  return run_captured(bench::run_program, arguments, stop);
}

}  // namespace reckon::test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program `reckon-bench` with the studies, which measure and compare `reckon`. Users call it as
// `reckon bench`, `reckon figures`, `reckon tune` and `reckon zwidth`.
#pragma once

#include <span>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {

/// All verbs, in the order in which help lists them.
[[nodiscard]] std::span<const tools::Verb> verbs();

/// Runs `reckon-bench ARGUMENTS` (without the program's name) and returns the exit status. Never
/// throws.
[[nodiscard]] int run_program(tools::Arguments arguments, const tools::Console& console) noexcept;

}  // namespace reckon::bench

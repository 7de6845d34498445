// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The program `reckon-peer`, which `reckon` starts for the verbs that verb_rows.hpp assigns to it.
#pragma once

#include <span>

#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {

/// The verbs of the program.
[[nodiscard]] std::span<const Verb> peer_verbs();

/// Runs `reckon-peer ARGUMENTS` (without the program's name) and returns the exit status. Never
/// throws.
[[nodiscard]] int run_peer_program(Arguments arguments, const Console& console) noexcept;

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/console.hpp"

#include <array>

namespace reckon::tools {
namespace {

constexpr std::array kExitMeanings{
    ExitMeaning{ExitCode::good, "good, also after Ctrl-C"},
    ExitMeaning{ExitCode::findings, "findings, or damaged input"},
    ExitMeaning{ExitCode::usage, "wrong usage, or a file that cannot be read"},
    ExitMeaning{ExitCode::environment, "network or device not usable"},
    ExitMeaning{ExitCode::internal, "a fault of the program"},
};

}  // namespace

std::span<const ExitMeaning> exit_meanings() { return kExitMeanings; }

}  // namespace reckon::tools

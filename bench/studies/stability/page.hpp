// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sweep of couplings as one HTML page: a map of each mode, all numbers of a cell where a pointer
// rests on it.
#pragma once

#include <string>

#include "reckon/bench/studies/stability/text.hpp"

namespace reckon::bench {

/// Needs no other file. Without scripts, and in print, the maps show the verdicts, told apart by
/// letters too; with scripts one number after the other can be shown.
[[nodiscard]] std::string stability_page(const StabilityReport& report);

}  // namespace reckon::bench

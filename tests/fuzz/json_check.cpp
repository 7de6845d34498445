// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compiled without the engine's coverage counters, so that it is steered by our own code only.
#include "reckon/tests/fuzz/json_check.hpp"

#include <nlohmann/json.hpp>

namespace reckon::fuzz {

bool is_json(std::string_view line) { return nlohmann::json::accept(line); }

}  // namespace reckon::fuzz

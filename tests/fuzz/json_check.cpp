// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Built without the engine's counters: what it steers by is our own code.
#include "reckon/tests/fuzz/json_check.hpp"

#include <nlohmann/json.hpp>

namespace reckon::fuzz {

bool is_json(std::string_view line) { return nlohmann::json::accept(line); }

}  // namespace reckon::fuzz

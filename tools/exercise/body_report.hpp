// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What became of a scene's bodies in a run, reported at its end.
#pragma once

#include <cstdio>
#include <string>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::tools {

/// A line, and one more for steps that were not exact. Nothing without bodies. The servos rest.
void print_bodies(std::FILE* out, const haptics::BodyWorld* bodies);
/// A member of a JSON object, a comma before it; null without bodies. docs/json_lines.md has it.
[[nodiscard]] std::string bodies_json(const haptics::BodyWorld* bodies);

}  // namespace reckon::tools

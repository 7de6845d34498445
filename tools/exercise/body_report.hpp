// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Summary of a scene's bodies at the end of a run.
#pragma once

#include <cstdio>
#include <string>

#include "reckon/haptics/bodies/body_world.hpp"

namespace reckon::tools {

/// One line, and one more for steps that were not exact; nothing without bodies. The servos must be
/// stopped.
void print_bodies(std::FILE* out, const haptics::BodyWorld* bodies);
/// A member of a JSON object, with a comma before it; null without bodies. See docs/json_lines.md.
[[nodiscard]] std::string bodies_json(const haptics::BodyWorld* bodies);

}  // namespace reckon::tools

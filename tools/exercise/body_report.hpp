// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene's bodies in words: their owners, and a summary at the end of a run.
#pragma once

#include <cstdio>
#include <string>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::tools {

/// One line, and one more for steps that were not exact; nothing without bodies. The servos must be
/// stopped.
void print_bodies(std::FILE* out, const haptics::BodyWorld* bodies);
/// A member of a JSON object, with a comma before it; null without bodies. See docs/json_lines.md.
[[nodiscard]] std::string bodies_json(const haptics::BodyWorld* bodies);

/// Number of bodies of each owner, as a peer knows them: "28: 12 ours, 16 of 1:2; 34 hand-overs",
/// and REST while they rest. Empty if their owner is fixed.
/// @param is_alone whether its own bodies are called ours; else they have its address
[[nodiscard]] std::string owners_text(const peer::PeerView& view, bool is_alone);

}  // namespace reckon::tools

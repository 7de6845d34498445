// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene explain`: the stages of a servo step with their cost and the effects left
// out, the settings between peers, the capacities, and the parts of each peer.
#pragma once

#include <cstdio>

#include "reckon/tools/verbs/loaded_scene.hpp"

namespace reckon::tools {

/// Tables as text.
void explain_as_text(const LoadedScene& scene, std::FILE* out);
/// One JSON object a line; docs/json_lines.md describes the keys.
void explain_as_json(const LoadedScene& scene, std::FILE* out);

}  // namespace reckon::tools

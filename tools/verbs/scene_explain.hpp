// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon scene explain` says of a scene: the stages of a servo step with their cost and what
// is left out, what is between peers, how large things are made, and what each peer has.
#pragma once

#include <cstdio>

#include "reckon/tools/verbs/loaded_scene.hpp"

namespace reckon::tools {

/// Tables for a person.
void explain_as_text(const LoadedScene& scene, std::FILE* out);
/// One JSON object a line; docs/json_lines.md has the keys.
void explain_as_json(const LoadedScene& scene, std::FILE* out);

}  // namespace reckon::tools

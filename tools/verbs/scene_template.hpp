// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What `reckon scene new` prints.
#pragma once

#include <string_view>

namespace reckon::tools {

/// A scene file to start from: a table to touch and a hand; a device, entities and the rest as
/// comments, each line of which is good without its "# ".
[[nodiscard]] std::string_view scene_template() noexcept;

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene new`.
#pragma once

#include <string_view>

namespace reckon::tools {

/// A scene file to start from: a table and a hand, and comments with a device, entities and the
/// rest. Each comment line is valid without its "# ".
[[nodiscard]] std::string_view scene_template() noexcept;

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene new`.
#pragma once

#include <string_view>

namespace reckon::tools {

/// A scene file as a starting point: a table and a hand, with commented examples of a device,
/// entities and the rest. Each example line is valid without its "# ".
[[nodiscard]] std::string_view scene_template() noexcept;

}  // namespace reckon::tools

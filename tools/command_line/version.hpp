// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Version of the program.
#pragma once

#include <string_view>

namespace reckon::tools {

/// For example "0.1.0".
[[nodiscard]] std::string_view program_version() noexcept;

}  // namespace reckon::tools

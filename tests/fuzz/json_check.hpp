// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace reckon::fuzz {

/// True where `line` is one JSON value by RFC 8259; numbers, escapes and UTF-8 included.
[[nodiscard]] bool is_json(std::string_view line);

}  // namespace reckon::fuzz

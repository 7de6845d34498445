// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Text of any origin, as markings and names from the network are: any octets may come.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Octets of the UTF-8 sequence that `text` begins with, 0 where it is none (RFC 3629: no overlong
/// form, no surrogate, nothing above U+10FFFF) or empty.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// Whether the UTF-8 sequence `letter` is none that is seen: a control character (C0, DEL, C1), a
/// line or paragraph separator, or one that turns the direction of what stands beside it.
[[nodiscard]] bool is_control(std::string_view letter);

/// Appends `text` as valid UTF-8 that moves no cursor and breaks no line: a dot for each control
/// character, U+FFFD for each octet that is no UTF-8.
void append_clean_text(std::string& out, std::string_view text);

}  // namespace reckon::tools

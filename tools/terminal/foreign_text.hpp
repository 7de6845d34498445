// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Untrusted text, such as markings and names from the network, with any octets.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Octets of the UTF-8 sequence at the start of `text`; 0 if it is empty or invalid (RFC 3629: no
/// overlong form, no surrogate, nothing above U+10FFFF).
[[nodiscard]] std::size_t utf8_length(std::string_view text);

/// Whether the UTF-8 sequence `letter` is invisible: a control character (C0, DEL, C1), a line or
/// paragraph separator, or a character that changes the direction of its neighbours.
[[nodiscard]] bool is_control(std::string_view letter);

/// Appends `text` as valid UTF-8 that moves no cursor and breaks no line. Each control character
/// becomes a dot, each invalid octet U+FFFD.
void append_clean_text(std::string& out, std::string_view text);

/// Cleans each line of our own text that quotes foreign text, such as the problems of a file.
[[nodiscard]] std::string clean_lines(std::string_view text);

}  // namespace reckon::tools

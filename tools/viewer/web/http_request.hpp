// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Parses the head of an HTTP/1.1 request, as far as the viewer's server needs it. Accepts any
// octets; nothing throws or allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace reckon::tools {

/// Longest head that is read [octets]; a longer request is refused.
inline constexpr std::size_t kLongestHead = 8192;

/// Fields of a head. The views point into the octets that were read; an absent field is empty.
struct HttpRequest {
  std::string_view method;  ///< "GET"
  std::string_view path;    ///< "/stream", without the query
  std::string_view query;   ///< "word=1f2e", without the question mark
  std::string_view host, origin, upgrade, connection;
  std::string_view key, version, extensions;  ///< Sec-WebSocket-Key, -Version, -Extensions
  std::size_t length = 0;                     ///< of the head with its empty line [octets]
};

enum class RequestVerdict : std::uint8_t {
  incomplete,  ///< more octets are needed
  good,
  bad,      ///< no HTTP/1.1 head, or one of the fields above is repeated
  too_long  ///< more than kLongestHead without an end
};

/// Reads the head at the begin of `octets`.
[[nodiscard]] RequestVerdict read_request(std::string_view octets, HttpRequest& out) noexcept;

/// Removes the text before `end` from the front, and `end` too. @return that text without blanks
/// around it
std::string_view cut_trimmed(std::string_view& text, std::string_view end) noexcept;

/// Whether a list field contains this word, ignoring case: "keep-alive, Upgrade".
[[nodiscard]] bool lists_word(std::string_view list, std::string_view word) noexcept;

/// The value of `name` in a query, "" if it has none: "1f2e" for "word" in "a=1&word=1f2e".
[[nodiscard]] std::string_view value_in_query(std::string_view query,
                                              std::string_view name) noexcept;

}  // namespace reckon::tools

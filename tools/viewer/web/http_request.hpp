// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The head of an HTTP/1.1 request, as far as the viewer's server looks at it. Any octets will do:
// nothing throws or allocates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace reckon::tools {

/// Longest head that is read [octets]; who sends more is not listened to.
inline constexpr std::size_t kLongestHead = 8192;

/// What a head says. The views point into the octets that were read; a field that is absent is
/// empty.
struct HttpRequest {
  std::string_view method;  ///< "GET"
  std::string_view path;    ///< "/stream", without the query
  std::string_view query;   ///< "word=1f2e", without the question mark
  std::string_view host, origin, upgrade, connection;
  std::string_view key, version;  ///< of Sec-WebSocket-
  std::size_t length = 0;         ///< of the head with its empty line [octets]
};

enum class RequestVerdict : std::uint8_t {
  incomplete,  ///< more octets are needed
  good,
  bad,      ///< no head of HTTP/1.1, or one of the fields above comes twice
  too_long  ///< more than kLongestHead without an end
};

/// Reads the head that `octets` begin with.
[[nodiscard]] RequestVerdict read_request(std::string_view octets, HttpRequest& out) noexcept;

/// Whether a field that is a list names this word, whatever the case: "keep-alive, Upgrade".
[[nodiscard]] bool lists_word(std::string_view list, std::string_view word) noexcept;

/// The value of `name` in a query, "" where it has none: of "a=1&word=1f2e" by "word", "1f2e".
[[nodiscard]] std::string_view value_in_query(std::string_view query,
                                              std::string_view name) noexcept;

}  // namespace reckon::tools

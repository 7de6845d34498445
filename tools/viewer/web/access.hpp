// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Access control of the viewer: by the server's own addresses to view, and by a random word of this
// start to change the exercise.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::tools {

/// Checks the fields of a request. Hosts are compared as whole strings: a page of another site
/// whose name resolves to this host sends its own name, and is refused.
class Access {
 public:
  /// @param addresses of the server, as a browser writes them: "127.0.0.1", "localhost", "[::1]"
  /// @param is_secure served by https
  Access(const std::vector<std::string>& addresses, std::uint16_t port, std::string word,
         bool is_secure = false);

  /// Whether this Host field names this server.
  [[nodiscard]] bool is_own_host(std::string_view host) const noexcept;
  /// Whether a page of this Origin is served by us at `host`, which is one of our addresses.
  [[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host) const noexcept;
  /// Whether this is the word; takes constant time.
  [[nodiscard]] bool is_word(std::string_view word) const noexcept;

  [[nodiscard]] const std::string& word() const noexcept { return word_; }
  /// "http://" or "https://".
  [[nodiscard]] std::string_view scheme() const noexcept { return scheme_; }

 private:
  std::vector<std::string> hosts_;
  std::string_view scheme_;
  std::string word_;
};

/// A new word: 32 random hexadecimal digits.
[[nodiscard]] std::string draw_word();

}  // namespace reckon::tools

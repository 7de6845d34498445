// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who may look at the viewer's pictures, and who may push: by the addresses that are the server's
// own, and by a word that only this start of it knows.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace reckon::tools {

/// Judges what a request says of itself. Hosts are compared as whole strings: a page of another
/// site whose name resolves to this host says its own name, and gets nothing.
class Access {
 public:
  /// @param addresses by which the server is reached, as a browser writes them: "127.0.0.1",
  /// "localhost", "[::1]"  @param is_secure served by https
  Access(const std::vector<std::string>& addresses, std::uint16_t port, std::string word,
         bool is_secure = false);

  /// Whether a request that says this Host is meant for us.
  [[nodiscard]] bool is_own_host(std::string_view host) const noexcept;
  /// Whether a page of this Origin is one of ours, reached as `host`, which is one of ours.
  [[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host) const noexcept;
  /// Whether this is the word; takes as long for a wrong one.
  [[nodiscard]] bool is_word(std::string_view word) const noexcept;

  [[nodiscard]] const std::string& word() const noexcept { return word_; }
  /// "http://" or "https://".
  [[nodiscard]] std::string_view scheme() const noexcept { return scheme_; }

 private:
  std::vector<std::string> hosts_;
  std::string_view scheme_;
  std::string word_;
};

/// A new word: 32 hexadecimal digits, drawn at random.
[[nodiscard]] std::string draw_word();

}  // namespace reckon::tools

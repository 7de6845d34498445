// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Writes JSON, member by member, with untrusted text as JSON strings. pdu/print.hpp prints whole
// PDUs as JSON.
#pragma once

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::tools {

/// Appends `text` in quotes; control characters, quotes and backslashes are escaped. Accepts any
/// octets: invalid UTF-8 becomes U+FFFD, so that the line stays valid JSON.
void append_json_string(std::string& out, std::string_view text);

/// One object, appended to a growing string. Keys are ours: letters and underscores.
///
///   JsonObject(out).text("file", name).value("frames", 12).end("\n");
///   // {"file":"a","frames":12}
class JsonObject {
 public:
  explicit JsonObject(std::string& out) : out_(out) { out_ += '{'; }

  /// Untrusted text.
  JsonObject& text(std::string_view key, std::string_view value) {
    append_json_string(member(key), value);
    return *this;
  }
  /// Whole numbers, `true` and `false`, and text that already is JSON.
  JsonObject& value(std::string_view key, const auto& value) {
    fmt::format_to(std::back_inserter(member(key)), FMT_COMPILE("{}"), value);
    return *this;
  }
  /// A number; null if there is none or it is not finite.
  JsonObject& number(std::string_view key, std::optional<double> number) {
    if (number && std::isfinite(*number)) return value(key, *number);
    return value(key, "null");
  }
  /// A finite number with `count` decimals.
  JsonObject& decimals(std::string_view key, double value, int count) {
    fmt::format_to(std::back_inserter(member(key)), "{:.{}f}", value, count);
    return *this;
  }
  /// An array; `append(out, row)` writes the JSON of each row.
  JsonObject& array(std::string_view key, const auto& rows, auto&& append) {
    member(key) += '[';
    bool first = true;
    for (const auto& row : rows) {
      if (!first) out_ += ',';
      first = false;
      append(out_, row);
    }
    out_ += ']';
    return *this;
  }
  /// Writes the key. The caller appends its value to the returned string.
  std::string& member(std::string_view key) {
    if (!first_) out_ += ',';
    first_ = false;
    fmt::format_to(std::back_inserter(out_), FMT_COMPILE("\"{}\":"), key);
    return out_;
  }
  /// Closes the object, once.
  void end(std::string_view behind = {}) {
    out_ += '}';
    out_ += behind;
  }

 private:
  std::string& out_;
  bool first_ = true;
};

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads a text word by word and counts its lines, for mesh files. Private to the readers.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace reckon::haptics {

/// Words are separated by blanks. '#' at the start of a word hides the rest of its line; a
/// backslash at the end of a line joins the next one to it.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) noexcept : text_(text) {}

  /// Goes to the start of the next line with a word. @return false at the end of the text.
  [[nodiscard]] bool next_line() noexcept;
  /// The next word of this line; empty after the last.
  [[nodiscard]] std::string_view word() noexcept;
  /// The next word, on this line or a later one; empty at the end of the text.
  [[nodiscard]] std::string_view word_of_any_line() noexcept;

  /// Number of this line, from 1; 0 before the first.
  [[nodiscard]] std::size_t line() const noexcept { return line_; }
  /// The text after the end of this line.
  [[nodiscard]] std::string_view behind_line() const noexcept;

 private:
  void skip_blanks() noexcept;
  [[nodiscard]] bool at_line_end() const noexcept;

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 0;
};

/// The whole `word` as a number, rounded once to double; accepts "nan" and "inf".
[[nodiscard]] std::optional<double> to_number(std::string_view word) noexcept;
/// The whole `word` as an integer.
[[nodiscard]] std::optional<long long> to_integer(std::string_view word) noexcept;

}  // namespace reckon::haptics

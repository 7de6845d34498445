// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/mesh_files/text_cursor.hpp"

#include <charconv>
#include <limits>

namespace reckon::haptics {

namespace {

bool is_blank(char letter) noexcept {
  return letter == ' ' || letter == '\t' || letter == '\r' || letter == '\v' || letter == '\f';
}

std::string_view without_plus(std::string_view word) noexcept {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return word;
}

}  // namespace

void TextCursor::skip_blanks() noexcept {
  while (at_ < text_.size()) {
    if (is_blank(text_[at_])) {
      ++at_;
      continue;
    }
    const std::string_view rest = text_.substr(at_, 3);
    const bool joined = rest.starts_with("\\\n") || rest.starts_with("\\\r\n");
    if (!joined) return;
    at_ += rest[1] == '\n' ? 2 : 3;
    ++line_;
  }
}

bool TextCursor::at_line_end() const noexcept {
  return at_ >= text_.size() || text_[at_] == '\n' || text_[at_] == '#';
}

bool TextCursor::next_line() noexcept {
  while (at_ < text_.size()) {
    if (line_ > 0) {
      const std::size_t end = text_.find('\n', at_);
      if (end == std::string_view::npos) return false;
      at_ = end + 1;
    }
    ++line_;
    skip_blanks();
    if (!at_line_end()) return true;
  }
  return false;
}

std::string_view TextCursor::word() noexcept {
  skip_blanks();
  if (at_line_end()) return {};
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n') ++at_;
  return text_.substr(begin, at_ - begin);
}

std::string_view TextCursor::word_of_any_line() noexcept {
  std::string_view found = line_ > 0 ? word() : std::string_view();
  while (found.empty() && next_line()) found = word();
  return found;
}

std::string_view TextCursor::behind_line() const noexcept {
  const std::size_t end = text_.find('\n', at_);
  return end == std::string_view::npos ? std::string_view() : text_.substr(end + 1);
}

std::optional<double> to_number(std::string_view word) noexcept {
  word = without_plus(word);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  // Beyond the range of a double, in either direction.
  if (error == std::errc::result_out_of_range) {
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    return tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

std::optional<long long> to_integer(std::string_view word) noexcept {
  word = without_plus(word);
  long long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace reckon::haptics

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/toml_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {
namespace {

/// True for the first octet of a UTF-8 character.
bool begins_letter(char octet) { return (static_cast<unsigned char>(octet) & 0xC0) != 0x80; }

/// Scans a text token by token, for keys, brackets and strings only.
class BoundsCheck {
 public:
  BoundsCheck(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  void run() {
    while (at_ < text_.size()) take(text_[at_]);
  }

 private:
  /// The state outside an open bracket.
  struct Outer {
    std::size_t level;
    bool is_table;
  };

  void take(char letter) {
    if (letter == '"' || letter == '\'') return skip_text(letter);
    if (letter == '#') return skip_to(text_.find('\n', at_));
    ++at_;
    if (letter == '\n') return end_line();
    if (letter == '[' || letter == '{') return open(letter == '{');
    if (letter == ']' || letter == '}') return close();
    if (letter == '=') in_key_ = false;
    if (letter == ',') begin_element();
    if (letter == '.' && in_key_) deepen();
  }

  // A key at the beginning of a line belongs to the table of the last header.
  void end_line() {
    ++line_;
    line_begin_ = at_;
    if (!outer_.empty()) return;
    if (in_header_) header_level_ = level_;
    in_header_ = false;
    begin_key(header_level_);
  }

  void begin_key(std::size_t level) {
    level_ = level;
    in_key_ = true;
    deepen();
  }

  void begin_element() {
    if (outer_.empty()) return;
    if (outer_.back().is_table) return begin_key(outer_.back().level);
    count_value();
  }

  // A bracket instead of a key opens a header.
  void open(bool is_table) {
    if (outer_.empty() && in_key_) {
      if (!in_header_) level_ = 1;
      in_header_ = true;
      return;
    }
    outer_.push_back({level_, is_table});
    if (is_table) return begin_key(level_);
    deepen();
  }

  void close() {
    if (outer_.empty()) return;
    level_ = outer_.back().level;
    outer_.pop_back();
    in_key_ = false;
  }

  void deepen() {
    if (++level_ > kMostTomlLevels)
      refuse(fmt::format(
          "more than {} nested tables and arrays (each part of a dotted key counts); nest fewer",
          kMostTomlLevels));
    count_value();
  }

  void count_value() {
    if (++values_ > kMostTomlValues)
      refuse(fmt::format("more than {} keys and values; use fewer", kMostTomlValues));
  }

  // Skips a string with one or three quotes. A single-line string ends with its line at the latest.
  void skip_text(char quote) {
    const std::string three(3, quote);
    const bool is_long = text_.substr(at_, 3) == three;
    at_ += is_long ? 3 : 1;
    while (at_ < text_.size()) {
      const char letter = text_[at_];
      if (letter == '\n' && !is_long) return;
      if (is_long && text_.substr(at_, 3) == three) return skip_closing(quote);
      ++at_;
      if (!is_long && letter == quote) return;
      if (letter == '\n') {
        ++line_;
        line_begin_ = at_;
      }
      if (letter == '\\' && quote == '"' && at_ < text_.size() && text_[at_] != '\n') ++at_;
    }
  }

  // Up to two quotes may precede the three closing ones.
  void skip_closing(char quote) {
    const std::size_t end = text_.find_first_not_of(quote, at_);
    skip_to(end == text_.npos ? end : std::min(end, at_ + 5));
  }

  void skip_to(std::size_t place) { at_ = std::min(place, text_.size()); }

  [[noreturn]] void refuse(std::string sentence) const {
    const auto column =
        std::ranges::count_if(text_.substr(line_begin_, at_ - line_begin_), begins_letter);
    throw SceneFileError(file_, {{line_, static_cast<std::uint32_t>(column), std::move(sentence)}});
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t at_ = 0, line_begin_ = 0;
  std::uint32_t line_ = 1;
  std::vector<Outer> outer_;  // open brackets
  std::size_t level_ = 1;     // of the present value
  std::size_t header_level_ = 0;
  bool in_key_ = true, in_header_ = false;
  std::size_t values_ = 0;
};

}  // namespace

void check_text_bounds(std::string_view text, const std::string& file) {
  if (text.size() > kMostTomlOctets)
    throw SceneFileError(
        file, {{0, 0, fmt::format("more than {} MiB of text; use less", kMostTomlOctets >> 20)}});
  BoundsCheck(text, file).run();
}

}  // namespace reckon::peer

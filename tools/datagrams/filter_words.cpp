// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/filter_words.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstddef>
#include <span>

#include "reckon/peer/notation/nearest_word.hpp"

namespace reckon::tools {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return result;
}

std::string word_of(std::string_view name) {
  std::string word = lower(name);
  for (char& letter : word) {
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  }
  return word.starts_with("drm_") ? word.substr(4) : word;
}

void WordSearch::look_at(std::string_view word) {
  is_found_ = is_found_ || word == typed_;
  if (word == nearest_) return;
  const std::array<std::string_view, 2> both{nearest_, word};
  const auto candidates = std::span(both).subspan(nearest_.empty() ? 1 : 0);
  if (peer::nearest_word(typed_, candidates) == word) nearest_ = word;
}

std::string suggestion(std::string_view nearest, std::string_view otherwise) {
  return nearest.empty() ? std::string(otherwise) : fmt::format("; did you mean '{}'?", nearest);
}

bool is_like(std::string_view text, std::string_view pattern) {
  std::size_t at = 0;
  std::size_t in = 0;
  std::size_t star = std::string_view::npos;
  std::size_t after_star = 0;
  while (at < text.size()) {
    if (in < pattern.size() && pattern[in] == '*') {
      star = in++;
      after_star = at;
    } else if (in < pattern.size() && pattern[in] == text[at]) {
      ++in;
      ++at;
    } else if (star != std::string_view::npos) {
      in = star + 1;
      at = ++after_star;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', in) == std::string_view::npos;
}

}  // namespace reckon::tools

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of filter comparisons: operators, and words of any spelling.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace reckon::tools {

enum class FilterOperator : std::uint8_t { equal, unequal, less, at_most, greater, at_least };

/// Whether `value` is in this relation to `number`; a NaN is unequal to all.
template <typename Number>
[[nodiscard]] bool holds(Number value, FilterOperator op, Number number) {
  switch (op) {
    case FilterOperator::equal:
      return value == number;
    case FilterOperator::unequal:
      return value != number;
    case FilterOperator::less:
      return value < number;
    case FilterOperator::at_most:
      return value <= number;
    case FilterOperator::greater:
      return value > number;
    case FilterOperator::at_least:
      return value >= number;
  }
  return false;
}

/// In lower case.
[[nodiscard]] std::string lower(std::string_view text);

/// A name as one word: "Life form" is life_form, "DRM FPW" fpw.
[[nodiscard]] std::string word_of(std::string_view name);

/// Searches for a typed word among words that are passed one at a time, as there may be hundreds.
class WordSearch {
 public:
  explicit WordSearch(std::string_view typed) : typed_(typed) {}

  void look_at(std::string_view word);

  [[nodiscard]] bool is_found() const { return is_found_; }
  /// The nearest word; empty if none is near.
  [[nodiscard]] const std::string& nearest() const { return nearest_; }

 private:
  std::string typed_;
  std::string nearest_;
  bool is_found_ = false;
};

/// "; did you mean 'platform'?", or `otherwise` if no word is near.
[[nodiscard]] std::string suggestion(std::string_view nearest, std::string_view otherwise = {});

/// Whether `text` matches `pattern`, in which * matches any letters. Linear time, except for the
/// stars.
[[nodiscard]] bool is_like(std::string_view text, std::string_view pattern);

}  // namespace reckon::tools

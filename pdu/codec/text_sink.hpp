// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Destination of printed text: a fixed buffer, which truncates and reports it, or a growing string.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace reckon::pdu {

/// Takes text and numbers. With a buffer it neither allocates nor throws.
class TextSink {
 public:
  explicit TextSink(std::span<char> buffer) noexcept : buffer_(buffer) {}
  explicit TextSink(std::string& text) noexcept : string_(&text) {}

  void text(std::string_view value) {
    if (string_ != nullptr) {
      string_->append(value);
      return;
    }
    const std::size_t taken = std::min(value.size(), buffer_.size() - size_);
    std::copy_n(value.begin(), taken, buffer_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += taken;
    truncated_ = truncated_ || taken < value.size();
  }
  void text(char value) { text(std::string_view(&value, 1)); }
  /// Shortest text that converts back to the same number.
  void number(auto value) {
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text(std::string_view(digits, static_cast<std::size_t>(end - digits)));
  }

  /// Content of the buffer; empty for a string sink.
  [[nodiscard]] std::string_view view() const noexcept { return {buffer_.data(), size_}; }
  /// Whether the buffer was too small for the text.
  [[nodiscard]] bool truncated() const noexcept { return truncated_; }

 private:
  std::span<char> buffer_;
  std::string* string_ = nullptr;
  std::size_t size_ = 0;
  bool truncated_ = false;
};

}  // namespace reckon::pdu

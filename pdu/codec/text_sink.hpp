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
    if (!has_room(value.size())) return append_or_cut(value);
    std::copy_n(value.data(), value.size(), buffer_.data() + size_);
    size_ += value.size();
  }
  void text(char value) {
    if (string_ != nullptr) {
      string_->push_back(value);
    } else if (size_ < buffer_.size()) {
      buffer_[size_++] = value;
    } else {
      truncated_ = true;
    }
  }
  /// Shortest text that converts back to the same number.
  void number(auto value) {
    char digits[kMostDigits];
    char* const begin = has_room(kMostDigits) ? &buffer_[size_] : digits;
    const char* end = std::to_chars(begin, begin + kMostDigits, value).ptr;
    const auto length = static_cast<std::size_t>(end - begin);
    if (begin == digits)
      text(std::string_view(digits, length));
    else
      size_ += length;
  }

  /// Content of the buffer; empty for a string sink.
  [[nodiscard]] std::string_view view() const noexcept { return {buffer_.data(), size_}; }
  /// Whether the buffer was too small for the text.
  [[nodiscard]] bool truncated() const noexcept { return truncated_; }

 private:
  static constexpr std::size_t kMostDigits = 40;
  [[nodiscard]] bool has_room(std::size_t length) const noexcept {
    return buffer_.size() - size_ >= length;
  }

  void append_or_cut(std::string_view value) {
    if (string_ != nullptr) {
      string_->append(value);
      return;
    }
    const std::size_t taken = buffer_.size() - size_;
    std::copy_n(value.data(), taken, buffer_.data() + size_);
    size_ += taken;
    truncated_ = true;
  }

  std::span<char> buffer_;  // empty with a string
  std::string* string_ = nullptr;
  std::size_t size_ = 0;
  bool truncated_ = false;
};

}  // namespace reckon::pdu

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Iteration over consecutive records in a datagram, without a copy of the block.
#pragma once

#include <cstddef>
#include <iterator>
#include <span>

#include "reckon/pdu/codec/codec.hpp"

namespace reckon::pdu {

/// Range-for over any cursor with `bool next(Value&)`. The cursor is copied, so that a range can be
/// iterated several times.
template <typename Cursor, typename Value>
class CursorRange {
 public:
  class Iterator {
   public:
    using value_type = Value;
    using difference_type = std::ptrdiff_t;

    explicit Iterator(const Cursor& cursor) noexcept : cursor_(cursor) { ++*this; }
    // By value, so that `*range.begin()` never refers to an expired iterator.
    [[nodiscard]] Value operator*() const noexcept { return value_; }
    Iterator& operator++() noexcept {
      valid_ = cursor_.next(value_);
      return *this;
    }
    void operator++(int) noexcept { ++*this; }
    [[nodiscard]] bool operator==(std::default_sentinel_t) const noexcept { return !valid_; }

   private:
    Cursor cursor_;
    Value value_{};
    bool valid_ = false;
  };

  explicit CursorRange(const Cursor& cursor) noexcept : cursor_(cursor) {}
  [[nodiscard]] Iterator begin() const noexcept { return Iterator(cursor_); }
  [[nodiscard]] std::default_sentinel_t end() const noexcept { return {}; }

 private:
  Cursor cursor_;
};

/// Reads equal records from a view, one for each kFixedSize<Record> octets.
template <typename Record>
class RecordCursor {
 public:
  explicit RecordCursor(std::span<const std::byte> bytes) noexcept : rest_(bytes) {}
  [[nodiscard]] bool next(Record& out) noexcept {
    if (!load_record(rest_, out)) return false;
    rest_ = rest_.subspan(kFixedSize<Record>);
    return true;
  }

 private:
  std::span<const std::byte> rest_;
};

/// `for (const FixedDatum& datum : records_of<FixedDatum>(data.fixed_datums))`
template <typename Record>
[[nodiscard]] auto records_of(std::span<const std::byte> bytes) noexcept {
  return CursorRange<RecordCursor<Record>, Record>(RecordCursor<Record>(bytes));
}

}  // namespace reckon::pdu

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Due times of the rows of a table: time-outs, and checks of distant entities.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "reckon/peer/world/row_column.hpp"

namespace reckon::peer {

/// One due time for each row, in the order of the rows (RowColumn). A pass reads 8 octets for each
/// block of 64 rows, and the blocks in which a row may be due:
///
///   for (std::size_t i = dues.next_due(now, 0); i < dues.size(); i = dues.next_due(now, i)) {
///     ...  // set(i, later) or erase(i)
///   }
///
/// One thread; allocates only at construction. A pass costs a few ns if nothing is due, else some
/// 0.5 ns a block and 40 ns a block with a due row.
class DueColumn {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  /// @param capacity most rows.
  explicit DueColumn(std::size_t capacity);

  void push(Nanoseconds due);
  /// `place` is below size().
  void set(std::size_t place, Nanoseconds due) noexcept;
  /// Prefetches the memory that set(place) writes.
  void prefetch(std::size_t place) const noexcept { __builtin_prefetch(&due_[place], 1); }
  /// Moves the last row to `place`, which is below size().
  void erase(std::size_t place) noexcept;

  /// The first place from `from` on that is due at `now`; size() or more if there is none. Before
  /// the next pass the caller makes a returned place due later, or erases it.
  [[nodiscard]] std::size_t next_due(Nanoseconds now, std::size_t from) noexcept;

  [[nodiscard]] Nanoseconds operator[](std::size_t place) const noexcept { return due_[place]; }
  [[nodiscard]] std::size_t size() const noexcept { return due_.size(); }

 private:
  static constexpr std::size_t kBlock = 64;

  void note(std::size_t place, Nanoseconds due) noexcept;

  RowColumn<Nanoseconds> due_;
  std::vector<Nanoseconds> earliest_;       // of each block, or an earlier time
  Nanoseconds first_ = Nanoseconds::max();  // of all blocks, or an earlier time
};

}  // namespace reckon::peer

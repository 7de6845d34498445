// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When something is to be done with each row of a table: time-outs, and looks at what is far away.
#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "reckon/peer/world/row_column.hpp"

namespace reckon::peer {

/// An instant for each row, in the order of the rows (RowColumn). A pass over what is due looks at
/// 8 octets of each block of 64 rows, and into those blocks where something may be due:
///
///   for (std::size_t i = dues.next_due(now, 0); i < dues.size(); i = dues.next_due(now, i)) {
///     ...  // set(i, later) or erase(i)
///   }
///
/// One thread; allocates only at construction. Where nothing is due a pass costs a few ns, else
/// some 0.5 ns a block and 40 ns a block with something in it.
class DueColumn {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  /// @param capacity most rows.
  explicit DueColumn(std::size_t capacity);

  void push(Nanoseconds due);
  /// `place` is below size().
  void set(std::size_t place, Nanoseconds due) noexcept;
  /// Has what set(place) writes brought near.
  void prefetch(std::size_t place) const noexcept { __builtin_prefetch(&due_[place], 1); }
  /// The last row goes to `place`, which is below size().
  void erase(std::size_t place) noexcept;

  /// The first place from `from` on whose instant is not after `now`; size() or more where there is
  /// none. Whoever goes on from a place has made it due later, or erased it, or does so before the
  /// next pass.
  [[nodiscard]] std::size_t next_due(Nanoseconds now, std::size_t from) noexcept;

  [[nodiscard]] Nanoseconds operator[](std::size_t place) const noexcept { return due_[place]; }
  [[nodiscard]] std::size_t size() const noexcept { return due_.size(); }

 private:
  static constexpr std::size_t kBlock = 64;

  void note(std::size_t place, Nanoseconds due) noexcept;

  RowColumn<Nanoseconds> due_;
  std::vector<Nanoseconds> earliest_;       // of each block, or before it
  Nanoseconds first_ = Nanoseconds::max();  // of all, or before it
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/due_column.hpp"

#include <algorithm>

namespace reckon::peer {

DueColumn::DueColumn(std::size_t capacity) : due_(capacity) {
  earliest_.reserve((capacity + kBlock - 1) / kBlock);
}

void DueColumn::push(Nanoseconds due) {
  due_.push(due);
  if (earliest_.size() * kBlock < due_.size()) earliest_.push_back(due);
  note(due_.size() - 1, due);
}

void DueColumn::set(std::size_t place, Nanoseconds due) noexcept {
  due_[place] = due;
  note(place, due);
}

void DueColumn::note(std::size_t place, Nanoseconds due) noexcept {
  Nanoseconds& earliest = earliest_[place / kBlock];
  earliest = std::min(earliest, due);
  first_ = std::min(first_, due);
}

void DueColumn::erase(std::size_t place) noexcept {
  if (place + 1 < due_.size()) note(place, due_.all().back());
  due_.erase(place);
  if ((earliest_.size() - 1) * kBlock == due_.size()) earliest_.pop_back();
}

std::size_t DueColumn::next_due(Nanoseconds now, std::size_t from) noexcept {
  if (first_ > now) return size();
  for (std::size_t block = from / kBlock; block < earliest_.size(); ++block) {
    if (earliest_[block] > now) continue;
    const std::size_t start = block * kBlock, end = std::min(start + kBlock, size());
    for (std::size_t place = std::max(from, start); place < end; ++place)
      if (due_[place] <= now) return place;
    const auto begin = due_.all().begin();
    earliest_[block] = *std::min_element(begin + static_cast<std::ptrdiff_t>(start),
                                         begin + static_cast<std::ptrdiff_t>(end));
  }
  first_ = earliest_.empty() ? Nanoseconds::max()
                             : *std::min_element(earliest_.begin(), earliest_.end());
  return size();
}

}  // namespace reckon::peer

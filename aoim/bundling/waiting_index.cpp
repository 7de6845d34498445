// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/bundling/waiting_index.hpp"

#include <algorithm>
#include <bit>

namespace reckon::aoim {
namespace {

constexpr std::size_t kLeastEntries = 1024;

}  // namespace

WaitingIndex::WaitingIndex()
    : entries_(kLeastEntries), shift_(64 - std::countr_zero(kLeastEntries)) {}

void WaitingIndex::reset(std::size_t live) {
  const std::size_t size = std::max(entries_.size(), std::bit_ceil(4 * live));
  entries_.assign(size, Entry{});
  shift_ = 64 - std::countr_zero(size);
  used_ = 0;
}

}  // namespace reckon::aoim

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/large_pages.hpp"

#include <sys/mman.h>

#include <cstdint>

namespace reckon::peer {

void advise_large_pages(const void* begin, std::size_t octets) noexcept {
  constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;
  const auto start = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (start + kSmallTable + kPage - 1) / kPage * kPage;
  const std::uintptr_t last = (start + octets) / kPage * kPage;
  if (first >= last) return;
  // If the system refuses, pages stay small.
  static_cast<void>(madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE));
}

void give_back_pages(const void* begin, std::size_t octets) noexcept {
  constexpr std::uintptr_t kPage = 4096;
  constexpr int kEvenLocked = 24;  // MADV_DONTNEED_LOCKED, since Linux 5.18: after mlockall
  const auto start = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (start + kPage - 1) / kPage * kPage;
  const std::uintptr_t last = (start + octets) / kPage * kPage;
  if (first >= last) return;
  auto* const pages = reinterpret_cast<void*>(first);
  if (madvise(pages, last - first, MADV_DONTNEED) != 0)
    static_cast<void>(madvise(pages, last - first, kEvenLocked));
}

}  // namespace reckon::peer

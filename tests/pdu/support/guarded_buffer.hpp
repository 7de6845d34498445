// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets that end exactly at an unreadable page: a read beyond them ends the test program.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <stdexcept>

namespace reckon::test {

/// Reusable for contents up to 64 KiB.
class GuardedBuffer {
 public:
  GuardedBuffer() {
    page_ = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    void* at =
        mmap(nullptr, kSize + page_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (at == MAP_FAILED) throw std::runtime_error("no memory for a guarded buffer");
    start_ = static_cast<std::byte*>(at);
    mprotect(start_ + kSize, page_, PROT_NONE);
  }
  GuardedBuffer(const GuardedBuffer&) = delete;
  GuardedBuffer& operator=(const GuardedBuffer&) = delete;
  ~GuardedBuffer() { munmap(start_, kSize + page_); }

  /// The same octets, at the end of the readable memory.
  std::span<std::byte> hold(std::span<const std::byte> octets) {
    std::byte* at = start_ + kSize - octets.size();
    std::copy(octets.begin(), octets.end(), at);
    return {at, octets.size()};
  }

 private:
  static constexpr std::size_t kSize = 65536;
  std::size_t page_ = 0;
  std::byte* start_ = nullptr;
};

}  // namespace reckon::test

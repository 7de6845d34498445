// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/support/allocation_guard.hpp"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t allocations = 0;
// Memory allocated on another thread may be freed here, so the sum is signed.
thread_local std::ptrdiff_t held = 0;
thread_local std::ptrdiff_t peak = 0;

void* taken(void* p) noexcept {
  ++allocations;
  held += static_cast<std::ptrdiff_t>(malloc_usable_size(p));
  peak = std::max(peak, held);
  return p;
}
void release(void* p) noexcept {
  held -= static_cast<std::ptrdiff_t>(malloc_usable_size(p));
  std::free(p);
}

void* counted(std::size_t size, std::size_t alignment) {
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* p = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
  if (p == nullptr) throw std::bad_alloc();
  return taken(p);
}
}  // namespace

void* operator new(std::size_t size) { return counted(size, alignof(std::max_align_t)); }
void* operator new(std::size_t size, std::align_val_t a) {
  return counted(size, static_cast<std::size_t>(a));
}
// std::stable_sort and similar functions allocate their scratch memory this way.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return taken(std::malloc(size));
}
void operator delete(void* p, const std::nothrow_t&) noexcept { release(p); }
void operator delete(void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace reckon::test {
AllocationGuard::AllocationGuard() : start_(allocations), held_(held) { peak = held; }
std::size_t AllocationGuard::count() const { return allocations - start_; }
std::size_t AllocationGuard::peak_octets() const { return static_cast<std::size_t>(peak - held_); }
}  // namespace reckon::test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/fuzz_target.hpp"

#include <fcntl.h>
#include <sanitizer/allocator_interface.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace reckon::fuzz {
namespace {

// Freeing memory from before the meter counts too, so the sum is signed.
struct HeapCount {
  std::size_t allocations = 0;
  std::ptrdiff_t held = 0;
  std::ptrdiff_t peak = 0;
};
thread_local HeapCount count;

void on_malloc(const volatile void*, std::size_t size) {
  ++count.allocations;
  count.held += static_cast<std::ptrdiff_t>(size);
  count.peak = std::max(count.peak, count.held);
}
void on_free(const volatile void* pointer) {
  if (pointer == nullptr) return;
  count.held -= static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(pointer));
}

[[maybe_unused]] const int kInstalled =
    __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);

}  // namespace

void require(bool holds, std::string_view sentence) noexcept {
  if (holds) return;
  std::fprintf(stderr, "reckon fuzz: %.*s\n", static_cast<int>(sentence.size()), sentence.data());
  std::abort();
}

InputOnDisk::InputOnDisk(std::string_view ending)
    : name_("/dev/shm/reckon_fuzz_" + std::to_string(::getpid()) + std::string(ending)) {}

InputOnDisk::~InputOnDisk() { ::unlink(name_.c_str()); }

const std::string& InputOnDisk::write(std::string_view octets) const {
  const int file = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const bool whole =
      ::write(file, octets.data(), octets.size()) == static_cast<ssize_t>(octets.size());
  ::close(file);
  require(whole, "no room for the input");
  return name_;
}

HeapMeter::HeapMeter() noexcept { count = {}; }
std::size_t HeapMeter::allocations() const noexcept { return count.allocations; }
std::size_t HeapMeter::peak() const noexcept { return static_cast<std::size_t>(count.peak); }

}  // namespace reckon::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  reckon::fuzz::check(std::as_bytes(std::span(data, size)));
  return 0;
}

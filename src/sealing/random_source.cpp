// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/random_source.hpp"

#include <sys/random.h>

#if defined(__x86_64__)
#include <cpuid.h>
#include <immintrin.h>
#endif

#include <algorithm>
#include <cerrno>

namespace reckon::peer {

namespace {

#if defined(__x86_64__)
bool has_rdrand() noexcept {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_RDRND) != 0;
}

// Adds random octets of the CPU: they are not in the memory that copies of a machine share.
__attribute__((target("rdrnd"))) void mix_in(std::span<std::byte> out) noexcept {
  static const bool kHas = has_rdrand();
  for (std::size_t i = 0; kHas && i < out.size(); i += sizeof(unsigned long long)) {
    unsigned long long word = 0;
    if (_rdrand64_step(&word) == 0) return;
    for (std::size_t k = i; k < std::min(i + sizeof word, out.size()); ++k, word >>= 8)
      out[k] ^= static_cast<std::byte>(word & 0xFF);
  }
}
#else
void mix_in(std::span<std::byte>) noexcept {}
#endif

}  // namespace

bool system_random(std::span<std::byte> out) noexcept {
  for (std::span<std::byte> left = out; !left.empty();) {
    const ssize_t got = ::getrandom(left.data(), left.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    left = left.subspan(static_cast<std::size_t>(got));
  }
  mix_in(out);
  return true;
}

std::uint64_t draw(RandomSource source) {
  std::uint64_t number = 0;
  if (!source(std::as_writable_bytes(std::span(&number, 1)))) throw RandomSourceError();
  return number;
}

}  // namespace reckon::peer

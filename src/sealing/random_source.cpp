// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/random_source.hpp"

#include <sys/random.h>

#include <cerrno>

namespace reckon::peer {

bool system_random(std::span<std::byte> out) noexcept {
  while (!out.empty()) {
    const ssize_t got = ::getrandom(out.data(), out.size(), 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    out = out.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

std::uint64_t draw(RandomSource source) {
  std::uint64_t number = 0;
  if (!source(std::as_writable_bytes(std::span(&number, 1)))) throw RandomSourceError();
  return number;
}

}  // namespace reckon::peer

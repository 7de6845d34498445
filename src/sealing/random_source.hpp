// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Source of boots and nonces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>

namespace reckon::peer {

/// Fills the octets with random ones; false if it cannot.
using RandomSource = bool (*)(std::span<std::byte>) noexcept;

/// Octets of the kernel's random source, getrandom(2), combined with RDRAND if the CPU has it: two
/// copies of one machine may get the same octets from their kernels for a time. 1 us.
[[nodiscard]] bool system_random(std::span<std::byte> out) noexcept;

/// The random source has failed, and an exercise cannot be sealed without it. An error of neither
/// usage nor the network.
class RandomSourceError : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override {
    return "the system's random source fails, and without it nothing can be sealed; see "
           "getrandom(2)";
  }
};

/// A number from that source.  @throws RandomSourceError
[[nodiscard]] std::uint64_t draw(RandomSource source);

}  // namespace reckon::peer

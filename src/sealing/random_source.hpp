// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Random numbers for sealing: the numbers that identify a start of a peer (boots), and nonces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>

namespace reckon::peer {

/// Fills the octets with random values. Returns false if the source fails.
using RandomSource = bool (*)(std::span<std::byte>) noexcept;

/// Octets of the kernel's random source, getrandom(2), combined with RDRAND if the CPU has it:
/// the kernels of two copies of a virtual machine may give the same octets for some time. Takes 1
/// us.
[[nodiscard]] bool system_random(std::span<std::byte> out) noexcept;

/// The random source has failed, and an exercise cannot be sealed without it. Neither the command
/// line nor the network is at fault: the program ends with the status of an internal error.
class RandomSourceError : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override {
    return "the system's random source fails, so nothing can be sealed; see getrandom(2)";
  }
};

/// A random number from `source`.  @throws RandomSourceError
[[nodiscard]] std::uint64_t draw(RandomSource source);

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where boots and nonces come from.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>

namespace reckon::peer {

/// Fills the octets with random ones; false where it cannot.
using RandomSource = bool (*)(std::span<std::byte>) noexcept;

/// The kernel's, getrandom(2), and where the CPU has RDRAND its own added: two copies of one
/// machine may draw the same from their kernels until these notice. 1 us.
[[nodiscard]] bool system_random(std::span<std::byte> out) noexcept;

/// The random source has failed: no exercise is sealed without. Neither a fault of usage nor of the
/// network.
class RandomSourceError : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override {
    return "the system's random source fails, and without it nothing can be sealed; see "
           "getrandom(2)";
  }
};

/// A number of that source. @throws RandomSourceError
[[nodiscard]] std::uint64_t draw(RandomSource source);

}  // namespace reckon::peer

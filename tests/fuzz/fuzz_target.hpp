// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Common parts of all fuzz targets: the entry point of the engine, a check that ends the run with a
// sentence, and a heap meter. docs/robustness.md lists the checks and how to run them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace reckon::fuzz {

/// Ends the program with `sentence` unless `holds`; the engine keeps the input.
void require(bool holds, std::string_view sentence) noexcept;

/// Checks one input of the engine. Each target defines it.
void check(std::span<const std::byte> input);

/// An input as text.
[[nodiscard]] inline std::string_view text_of(std::span<const std::byte> input) noexcept {
  return {reinterpret_cast<const char*>(input.data()), input.size()};
}
/// An input as numbers.
[[nodiscard]] inline std::span<const std::uint8_t> numbers_of(
    std::span<const std::byte> input) noexcept {
  return {reinterpret_cast<const std::uint8_t*>(input.data()), input.size()};
}

/// An in-memory file that holds the octets of one input after the other.
class InputOnDisk {
 public:
  /// @param ending of its name, as in ".obj"
  explicit InputOnDisk(std::string_view ending);
  ~InputOnDisk();
  InputOnDisk(const InputOnDisk&) = delete;
  InputOnDisk& operator=(const InputOnDisk&) = delete;
  /// @return its name
  const std::string& write(std::string_view octets) const;

 private:
  std::string name_;
};

/// Counts the heap allocations of this thread while the meter lives; one at a time.
class HeapMeter {
 public:
  HeapMeter() noexcept;
  /// Allocations since construction.
  [[nodiscard]] std::size_t allocations() const noexcept;
  /// Greatest number of octets held at one time since construction, beyond those held before.
  [[nodiscard]] std::size_t peak() const noexcept;
};

/// Heap that a datagram may cost beyond the codec, which allocates none: 4 times its size, and at
/// least the size of an error sentence.
[[nodiscard]] constexpr std::size_t heap_bound(std::size_t octets) noexcept {
  constexpr std::size_t kSentence = 1024;
  return octets * 4 < kSentence ? kSentence : octets * 4;
}

/// Limit in octets of the text of one datagram, as JSON with all fields or as a tree.
[[nodiscard]] constexpr std::size_t text_bound(std::size_t octets) noexcept {
  return 64 * octets + 1024;
}

}  // namespace reckon::fuzz

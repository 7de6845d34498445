// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The accepted datagrams of one stream: a bit for each of the newest 1024.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::peer {

/// Call take() only after the tag was verified: else a forged count moves the window and excludes
/// the genuine ones. 136 octets.
class ReplayWindow {
 public:
  static constexpr std::uint64_t kSpan = 1024;  ///< largest distance behind the newest one

  /// Whether this count was not taken and is not too old. Counts begin at 1. 2 ns.
  [[nodiscard]] bool is_fresh(std::uint64_t count) const noexcept {
    if (count == 0) return false;
    if (count > newest_) return true;
    return newest_ - count < kSpan && (word(count) & bit(count)) == 0;
  }

  [[nodiscard]] std::uint64_t newest() const noexcept { return newest_; }

  /// Records a fresh count.
  void take(std::uint64_t count) noexcept {
    if (count > newest_) advance(count);
    taken_[index(count)] |= bit(count);
  }

 private:
  void advance(std::uint64_t count) noexcept {
    if (count - newest_ >= kSpan) {
      taken_.fill(0);
    } else {
      for (std::uint64_t skipped = newest_ + 1; skipped <= count; ++skipped)
        taken_[index(skipped)] &= ~bit(skipped);
    }
    newest_ = count;
  }
  static std::size_t index(std::uint64_t count) noexcept { return count % kSpan / 64; }
  static std::uint64_t bit(std::uint64_t count) noexcept { return std::uint64_t{1} << count % 64; }
  [[nodiscard]] std::uint64_t word(std::uint64_t count) const noexcept {
    return taken_[index(count)];
  }

  std::uint64_t newest_{0};
  std::array<std::uint64_t, kSpan / 64> taken_{};
};

}  // namespace reckon::peer

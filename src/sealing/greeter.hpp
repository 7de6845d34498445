// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When a sealed link greets, and what: proves to others that it is alive, and asks them to.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/sealing/hello.hpp"
#include "reckon/peer/sealing/sealed_senders.hpp"

namespace reckon::peer {

/// One greeting answers many, and at most 50 go out in a second. One thread; no allocation.
class Greeter {
 public:
  static constexpr std::size_t kShortest = HelloWriter::kHead + HelloWriter::kEcho;
  static constexpr std::size_t kLongest = 1332;  ///< [octets]: 81 answers
  /// Of what a sender had sealed before it proved to be alive, no more is taken: recordings of
  /// the same life are at most so old.
  static constexpr std::uint64_t kTakenBefore = 64;

  /// @param boot own. @param nonce what others have to send back; drawn at random
  Greeter(std::uint64_t boot, std::uint64_t nonce) noexcept : own_{boot, nonce} {}

  /// When the next greeting is due; at once at first, never where nobody has to be answered or
  /// asked.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept { return next_; }

  /// Writes it and plans the next one. @param sealed own datagrams so far. @param room at least
  /// kShortest octets
  [[nodiscard]] std::span<const std::byte> write(SealedSenders& senders, std::uint64_t sealed,
                                                 std::span<std::byte> room,
                                                 std::chrono::nanoseconds now) noexcept;

  /// A sender was heard for the first time.
  void meet(const SealedSenders& senders, std::chrono::nanoseconds now) noexcept;

  /// A greeting of `sender`, who becomes trusted where our nonce is in it. False where the octets
  /// are none.
  [[nodiscard]] bool hear(std::span<const std::byte> octets, SealedSender& sender,
                          std::chrono::nanoseconds now) noexcept;

 private:
  void hurry(std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] bool answer(SealedSenders& senders, HelloWriter& writer) const noexcept;
  void ask(SealedSenders& senders, HelloWriter& writer,
           std::chrono::nanoseconds now) const noexcept;

  NonceEcho own_;
  std::uint64_t dropped_ = 0;
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::min();
  std::chrono::nanoseconds last_ = -std::chrono::seconds(1);
  std::chrono::nanoseconds patience_{0};
};

}  // namespace reckon::peer

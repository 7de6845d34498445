// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When a sealed link greets, and what: proves to others that it is alive, and asks them to.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/sealing/envelope_opener.hpp"
#include "reckon/peer/sealing/hello.hpp"

namespace reckon::peer {

/// One greeting answers many, and at most 50 go out in a second; for the sake of boots that have
/// not proved to be alive, as recordings cannot, far fewer. One thread; no allocation.
class Greeter {
 public:
  static constexpr std::size_t kShortest = HelloWriter::kHead + HelloWriter::kEcho;
  static constexpr std::size_t kLongest = 1320;  ///< [octets]: 81 answers
  /// Greetings for strangers, all together: so many at once, then one each so long.
  static constexpr int kStrangersAtOnce = 8;
  static constexpr std::chrono::nanoseconds kStrangersGap = std::chrono::milliseconds(125);
  /// A new nonce for the sake of what came outdated: one each so long.
  static constexpr std::chrono::nanoseconds kDoubtGap = std::chrono::seconds(1);

  /// @param boot own. @param nonce what others have to send back; drawn at random
  Greeter(std::uint64_t boot, std::uint64_t nonce) noexcept : own_{boot, nonce} {}

  /// Nothing that was said to us before proves anything any more.
  void begin_anew(std::uint64_t boot, std::uint64_t nonce) noexcept {
    *this = Greeter(boot, nonce);
  }

  /// When the next greeting is due; at once at first, never where nobody has to be answered or
  /// asked.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept { return next_; }

  /// Writes it and plans the next one. @param room at least kShortest octets
  [[nodiscard]] std::span<const std::byte> write(SealedSenders& senders, std::span<std::byte> room,
                                                 std::chrono::nanoseconds now) noexcept;

  /// A sender was heard for the first time.
  void meet(const SealedSenders& senders, std::chrono::nanoseconds now) noexcept;

  /// A greeting of a sender, who becomes trusted where our nonce is in it. False where the octets
  /// are none. @param received when it came
  [[nodiscard]] bool hear(const OpenedDatagram& greeting, std::chrono::nanoseconds received,
                          std::chrono::nanoseconds now) noexcept;

  /// One that is trusted says something later than ever, and at another time as it seems: a clock
  /// has leapt. All are asked anew.
  void doubt(std::chrono::nanoseconds now) noexcept;

 private:
  void hurry(std::chrono::nanoseconds now) noexcept;
  void hurry_for_stranger(std::chrono::nanoseconds now) noexcept;
  void plan_for_stranger(std::chrono::nanoseconds at) noexcept;
  void charge(std::chrono::nanoseconds now) noexcept;
  struct Answered {
    std::size_t count = 0;
    bool is_all = true;
  };
  [[nodiscard]] Answered answer(SealedSenders& senders, bool trusted,
                                HelloWriter& writer) const noexcept;
  void ask(SealedSenders& senders, HelloWriter& writer,
           std::chrono::nanoseconds now) const noexcept;

  NonceEcho own_;
  std::uint64_t dropped_ = 0;
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::min();
  std::chrono::nanoseconds last_ = -std::chrono::seconds(1);
  std::chrono::nanoseconds patience_{0};
  std::chrono::nanoseconds spent_until_ = -std::chrono::seconds(1);  ///< what strangers have had
  std::chrono::nanoseconds doubted_ = -kDoubtGap;
};

}  // namespace reckon::peer

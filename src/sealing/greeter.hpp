// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Schedule and content of the greetings of a sealed link. They prove to others that it is live, and
// request the same proof from them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/sealing/envelope_opener.hpp"
#include "reckon/peer/sealing/hello.hpp"

namespace reckon::peer {

/// One greeting answers many senders. At most 50 are sent in a second, and far fewer for boots that
/// are not proven to be live, because these may be recordings. One thread; no allocation.
class Greeter {
 public:
  static constexpr std::size_t kShortest = HelloWriter::kHead + HelloWriter::kEcho;
  static constexpr std::size_t kLongest = 1320;  ///< [octets]: 81 answers
  /// Greetings for all strangers together: this many at once, then one in each kStrangersGap.
  static constexpr int kStrangersAtOnce = 8;
  static constexpr std::chrono::nanoseconds kStrangersGap = std::chrono::milliseconds(125);
  /// Least gap between new nonces because of outdated datagrams.
  static constexpr std::chrono::nanoseconds kDoubtGap = std::chrono::seconds(1);

  /// @param boot own boot. @param nonce that others have to return; drawn at random
  Greeter(std::uint64_t boot, std::uint64_t nonce) noexcept : own_{boot, nonce} {}

  /// Invalidates everything that others proved before.
  void begin_anew(std::uint64_t boot, std::uint64_t nonce) noexcept {
    *this = Greeter(boot, nonce);
  }

  /// When the next greeting is due; at once at first, never if no answer or request is pending.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept { return next_; }

  /// Writes the greeting and plans the next one.  @param room at least kShortest octets
  [[nodiscard]] std::span<const std::byte> write(SealedSenders& senders, std::span<std::byte> room,
                                                 std::chrono::nanoseconds now) noexcept;

  /// Records the first datagram of a sender.
  void meet(const SealedSenders& senders, std::chrono::nanoseconds now) noexcept;

  /// Takes a greeting of a sender, which becomes trusted if it contains our nonce. False if the
  /// octets are no greeting.  @param received time of arrival
  [[nodiscard]] bool receive(const OpenedDatagram& greeting, std::chrono::nanoseconds received,
                             std::chrono::nanoseconds now) noexcept;

  /// A trusted sender has sent its latest datagram at an implausible time: a clock has jumped. All
  /// senders have to prove again that they are live.
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
  std::chrono::nanoseconds spent_until_ = -std::chrono::seconds(1);  ///< used by strangers
  std::chrono::nanoseconds doubted_ = -kDoubtGap;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sealing side of one opening: own boot, own keys, own counts.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/sealing/key_file.hpp"

namespace reckon::peer {

/// One for each sending thread: no two threads count in the same stream.
enum class SealingStream : std::uint16_t {
  datagrams = 0,  ///< of the peer: its write loop
  control = 1,    ///< of the link itself: its reader
};
inline constexpr std::size_t kSealingStreams = 2;

/// Seals under keys that no other process has: its boot is drawn at random at each construction,
/// also inside one process. A copy that is unaware of the other (a snapshot of the machine, a
/// fork) draws other salts: with XChaCha20 for each datagram, with AES-GCM for each kMostOfSalt and
/// at least each kLongestSalt. Each stream by one thread at a time; no allocation after
/// construction.
class EnvelopeSealer {
 public:
  /// Datagrams after which a stream seals no more: far below the range of its 48 bits, and far
  /// above the proper use of AES-GCM with one key, so change the epoch long before.
  static constexpr std::uint64_t kMostOfStream = std::uint64_t{1} << 40;
  /// Datagrams, and time, under one salt of AES-GCM. A larger number costs less: a draw with a key
  /// takes 1 us, at the sender and at each receiver.
  static constexpr unsigned kMostOfSalt = 256;
  static constexpr std::chrono::nanoseconds kLongestSalt = std::chrono::milliseconds(4);

  /// @param site, application present numbers of the program, for readers of captures.
  /// @param places covered by the tags.  @throws RandomSourceError
  EnvelopeSealer(const GroupKey& key, std::uint16_t site, std::uint16_t application,
                 const ExercisePlaces& places = {}, RandomSource random = system_random);
  ~EnvelopeSealer();
  EnvelopeSealer(const EnvelopeSealer&) = delete;
  EnvelopeSealer& operator=(const EnvelopeSealer&) = delete;

  [[nodiscard]] const Sealer& own() const noexcept { return own_; }

  /// The datagram to send: `plain` sealed in `room` for this destination, under epoch `epoch` of
  /// the key file (its index). Empty if the stream is at its end, the room too small, or the random
  /// source fails.  @param now steady time, does not fall
  [[nodiscard]] std::span<const std::byte> seal(SealingStream stream, std::size_t epoch,
                                                const IpEndpoint& to, std::chrono::nanoseconds now,
                                                std::span<const std::byte> plain,
                                                std::span<std::byte> room) noexcept;

  /// Changes to another boot and other keys, because this process may be one of two. No stream may
  /// be in use meanwhile. False if the random source fails: then nothing is sealed until this
  /// succeeds.
  [[nodiscard]] bool begin_anew() noexcept;

  /// Datagrams sealed in the stream so far; any thread.
  [[nodiscard]] std::uint64_t count(SealingStream stream) const noexcept {
    return streams_[static_cast<std::size_t>(stream)].count.load(std::memory_order_relaxed);
  }

  /// Continues the stream as if this many had been sealed; never back (assert).
  void skip_to(SealingStream stream, std::uint64_t count) noexcept;

 private:
  static constexpr std::size_t kNoEpoch = ~std::size_t{0};
  struct alignas(64) Stream {
    std::atomic<std::uint64_t> count{0};  // written only by the stream's thread
    std::size_t epoch = kNoEpoch;         // of `key`
    std::uint64_t salt = 0;
    unsigned left = 0;                  // datagrams that may still use the salt, of AES
    std::chrono::nanoseconds until{0};  // end of its use
    SealingKey key;
  };
  [[nodiscard]] bool make_ready(Stream& stream, std::size_t epoch,
                                std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] EnvelopeHeader header_of(std::size_t epoch) const noexcept;

  GroupKey key_;
  Sealer own_;
  ExercisePlaces places_;
  RandomSource random_;
  std::uint32_t stamp_origin_;  // hides for how long this host has been up
  bool is_good_ = true;         // has its own boot
  std::array<Stream, kSealingStreams> streams_{};
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sealing side of one opening: own boot, own keys, own counts.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/peer/sealing/key_file.hpp"

namespace reckon::peer {

/// One for each thread that sends: no two threads count in the same stream.
enum class SealingStream : std::uint16_t {
  datagrams = 0,  ///< what the peer says: its write loop
  control = 1,    ///< what the link itself says: its reader
};
inline constexpr std::size_t kSealingStreams = 2;

/// Seals under keys that nobody else has: its boot is drawn at random at each construction, also
/// inside one process. Each stream by one thread; no allocation after construction.
class EnvelopeSealer {
 public:
  /// Datagrams of one stream, after which it seals no more: far below what its 48 bits count, far
  /// above what AES-GCM under one key is meant for, so change the epoch long before.
  static constexpr std::uint64_t kMostOfStream = std::uint64_t{1} << 40;

  /// @param site, application what the program is called now, for those who look at captures.
  /// @throws RandomSourceError
  EnvelopeSealer(const GroupKey& key, std::uint16_t site, std::uint16_t application,
                 RandomSource random = system_random);
  ~EnvelopeSealer();
  EnvelopeSealer(const EnvelopeSealer&) = delete;
  EnvelopeSealer& operator=(const EnvelopeSealer&) = delete;

  [[nodiscard]] const Sealer& own() const noexcept { return header_.sealer; }

  /// The datagram to send: `plain` sealed in `room`, under epoch `epoch` of the key file (its
  /// index). Empty where the stream is at its end or the room too small.
  [[nodiscard]] std::span<const std::byte> seal(SealingStream stream, std::size_t epoch,
                                                std::span<const std::byte> plain,
                                                std::span<std::byte> room) noexcept;

  /// Datagrams sealed in the stream so far; any thread.
  [[nodiscard]] std::uint64_t count(SealingStream stream) const noexcept {
    return streams_[static_cast<std::size_t>(stream)].count.load(std::memory_order_relaxed);
  }

  /// As if so many had been sealed in the stream; never back (assert).
  void skip_to(SealingStream stream, std::uint64_t count) noexcept;

 private:
  struct alignas(64) Stream {
    std::atomic<std::uint64_t> count{0};  // written by the stream's thread alone
  };
  struct Epoch {
    std::uint16_t number;
    SealingKey key;
  };

  EnvelopeHeader header_;
  std::vector<Epoch> epochs_;
  std::array<Stream, kSealingStreams> streams_{};
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Senders that are proven to hold the group's key: their keys and windows, and whether they are
// live.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/envelope_sealer.hpp"
#include "reckon/peer/sealing/replay_window.hpp"
#include "reckon/peer/sealing/sender_time.hpp"

namespace reckon::peer {

/// One boot of one sealer.
struct SealedSender {
  /// For each stream: the key of the last salt or epoch, and the key before it.
  static constexpr std::size_t kKeys = 2;

  /// A key with its salt and epoch.
  struct Kept {
    bool is_made{false};
    std::uint16_t epoch{0};
    std::uint64_t salt{0};  ///< 0 if keys have none
    SealingKey key;
  };

  Sealer sealer;
  bool trusted{false};      ///< has answered our nonce, so it is no recording
  bool has_nonce{false};    ///< its own nonce is known, in `nonce`
  bool echo_due{false};     ///< it waits for our answer
  std::uint8_t held{0};     ///< datagrams that wait for its answer
  std::uint16_t next{0};    ///< of the same bucket
  std::uint64_t serial{0};  ///< of this entry: a sender that returns gets another
  std::uint64_t nonce{0};
  std::uint64_t nonce_count{0};  ///< of the greeting with it
  std::chrono::nanoseconds since{0}, heard{0};
  IpEndpoint address;  ///< first source address
  SenderTime time;     ///< if trusted
  std::array<ReplayWindow, kSealingStreams> windows;
  std::array<std::uint8_t, kSealingStreams> latest{};  ///< in `keys`
  std::array<std::array<Kept, kKeys>, kSealingStreams> keys;

  /// Its key for this header; null if none is kept.
  [[nodiscard]] const SealingKey* key_of(const EnvelopeHeader& header) const noexcept;
  /// Keeps the key, and drops the older key of the stream.
  void keep(const EnvelopeHeader& header, const SealingKey& kept) noexcept;
};

/// Bounded: 10.3 MiB of address space, of which a peer with 64 others touches 170 KiB. One thread;
/// no allocation after construction.
class SealedSenders {
 public:
  static constexpr std::size_t kMost = 4096;
  /// Most untrusted boots of one endpoint. Members first received through a relay have its address,
  /// so trusted boots do not count.
  static constexpr std::size_t kMostOfAddress = 4;

  SealedSenders();
  ~SealedSenders();
  SealedSenders(const SealedSenders&) = delete;
  SealedSenders& operator=(const SealedSenders&) = delete;

  /// Null if it is not known. 3 ns.
  [[nodiscard]] SealedSender* find(const Sealer& sealer) noexcept;

  /// Adds an unknown sender: not trusted, without a key. If its address or the table is full, it
  /// replaces the one silent for the longest, untrusted ones first.
  [[nodiscard]] SealedSender& add(const Sealer& sealer, const IpEndpoint& address,
                                  std::chrono::nanoseconds now) noexcept;

  /// Removes all.
  void clear() noexcept;

  [[nodiscard]] std::span<SealedSender> all() noexcept { return {senders_, size_}; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Trusted senders that were replaced: their windows are lost, so the own nonce has to change.
  [[nodiscard]] std::uint64_t trusted_dropped() const noexcept { return trusted_dropped_; }

 private:
  static constexpr std::size_t kBuckets = 8192;
  static constexpr std::uint16_t kNone = 0xFFFF;

  [[nodiscard]] std::uint16_t& bucket(const Sealer& sealer) noexcept {
    return buckets_[sealer.boot % kBuckets];
  }
  [[nodiscard]] std::size_t place_for(const IpEndpoint& address) noexcept;
  void unlink(std::size_t index) noexcept;

  SealedSender* senders_;  // room for kMost, of which the first size_ are made
  std::unique_ptr<std::array<std::uint16_t, kBuckets>> buckets_storage_;
  std::array<std::uint16_t, kBuckets>& buckets_;
  std::size_t size_ = 0;
  std::uint64_t made_ = 0;
  std::uint64_t trusted_dropped_ = 0;
};

}  // namespace reckon::peer

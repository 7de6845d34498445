// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whoever has proved to hold the group's key: keys, windows and whether he is of today.
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
  /// Of each stream: that of the last salt or epoch, and of the one before.
  static constexpr std::size_t kKeys = 2;

  /// A key of its, and what it was made from.
  struct Kept {
    bool is_made{false};
    std::uint16_t epoch{0};
    std::uint64_t salt{0};  ///< 0 where keys have none
    SealingKey key;
  };

  Sealer sealer;
  bool trusted{false};      ///< has answered our nonce, so it is no recording
  bool has_nonce{false};    ///< of its own, which is `nonce`
  bool echo_due{false};     ///< it waits for an answer of ours
  std::uint8_t held{0};     ///< datagrams that wait for its answer
  std::uint16_t next{0};    ///< of the same bucket
  std::uint64_t serial{0};  ///< of this entry: one that comes back has another
  std::uint64_t nonce{0};
  std::uint64_t nonce_count{0};  ///< of the greeting that said it
  std::chrono::nanoseconds since{0}, heard{0};
  IpEndpoint address;  ///< where it was heard first
  SenderTime time;     ///< where trusted
  std::array<ReplayWindow, kSealingStreams> windows;
  std::array<std::uint8_t, kSealingStreams> latest{};  ///< in `keys`
  std::array<std::array<Kept, kKeys>, kSealingStreams> keys;

  /// Its key for this header; null where none is kept.
  [[nodiscard]] const SealingKey* key_of(const EnvelopeHeader& header) const noexcept;
  /// Keeps the key, in the place of the older one of the stream.
  void keep(const EnvelopeHeader& header, const SealingKey& kept) noexcept;
};

/// Bounded: 10.3 MiB of address space, of which a peer with 64 others touches 170 KiB. One thread;
/// no allocation after construction.
class SealedSenders {
 public:
  static constexpr std::size_t kMost = 4096;
  /// Boots that are not trusted of one endpoint. Whoever passes on what members say is the address
  /// where these are heard first, so they do not count.
  static constexpr std::size_t kMostOfAddress = 4;

  SealedSenders();
  ~SealedSenders();
  SealedSenders(const SealedSenders&) = delete;
  SealedSenders& operator=(const SealedSenders&) = delete;

  /// Null where it is not known. 3 ns.
  [[nodiscard]] SealedSender* find(const Sealer& sealer) noexcept;

  /// A sender that is not known yet; not trusted, without a key. Where its address or the table is
  /// full it takes the place of the one longest silent, and of one not trusted before any trusted.
  [[nodiscard]] SealedSender& add(const Sealer& sealer, const IpEndpoint& address,
                                  std::chrono::nanoseconds now) noexcept;

  /// All are forgotten.
  void clear() noexcept;

  [[nodiscard]] std::span<SealedSender> all() noexcept { return {senders_, size_}; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Trusted ones that lost their place: their windows are forgotten, so the own nonce has to
  /// change.
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

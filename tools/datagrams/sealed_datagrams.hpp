// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sealed datagrams of a capture or a live group: opened with a key, else counted.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reckon/peer/capture/datagram_source.hpp"
#include "reckon/peer/sealing/key_file.hpp"

namespace reckon::tools {

/// Examines each datagram before it is read. It accepts replayed datagrams, because a capture may
/// contain them.
class SealedDatagrams {
 public:
  /// @param key_file empty: none. @throws UsageError if it cannot be used
  explicit SealedDatagrams(const std::string& key_file);

  /// Whether the datagram can be read: always if it is not sealed. A sealed one that opens is
  /// replaced by its content, which is valid until the next call.
  [[nodiscard]] bool open(peer::SourceDatagram& datagram);

  /// Sealed datagrams that could not be opened.
  [[nodiscard]] std::uint64_t unread() const noexcept { return unread_; }
  /// Lines for the user: number, senders, suite and epoch; empty if none was sealed.
  [[nodiscard]] std::string summary() const;

 private:
  /// Key of the counts.
  struct Kind {
    peer::Sealer sealer;
    peer::SealingSuite suite;
    std::uint16_t epoch;
    auto operator<=>(const Kind&) const = default;
  };
  struct Count {
    std::uint64_t datagrams = 0, opened = 0, greetings = 0;
    std::optional<std::uint8_t> exercise;  ///< exercise of its opened datagrams
  };
  /// Sender with a derived key; the last key of each is kept.
  struct Name {
    peer::Sealer sealer;
    std::uint16_t epoch, stream;
    auto operator<=>(const Name&) const = default;
  };
  struct Kept {
    std::uint64_t salt;
    peer::SealingKey key;
  };

  [[nodiscard]] Count& count_of(const peer::EnvelopeHeader& header);
  [[nodiscard]] const peer::SealingKey* key_of(const peer::EnvelopeHeader& header);
  [[nodiscard]] bool unseal(const peer::EnvelopeHeader& header, peer::SourceDatagram& datagram,
                            std::size_t front, Count& count);
  [[nodiscard]] bool unseal_for_any(const peer::SealingKey& key, const peer::GroupAddress& group,
                                    std::span<const std::byte> sealed, std::span<std::byte> plain,
                                    Count& count);

  std::optional<peer::GroupKey> key_;
  std::map<Kind, Count> counts_;
  std::map<Name, Kept> keys_;
  std::uint8_t exercise_ = 1;  // of the last opened datagram
  std::vector<std::byte> plain_;
  std::uint64_t unread_ = 0;
};

}  // namespace reckon::tools

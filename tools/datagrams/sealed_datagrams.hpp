// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sealed datagrams of a capture or a live group: opened where there is a key, counted where not.
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

/// Looks at each datagram before it is read. It refuses no replay: a capture is one.
class SealedDatagrams {
 public:
  /// @param key_file empty: none. @throws UsageError where it cannot be used
  explicit SealedDatagrams(const std::string& key_file);

  /// Whether there is something to read: always for what is not sealed; what is sealed and opens
  /// becomes what it carries, good until the next call.
  [[nodiscard]] bool open(peer::SourceDatagram& datagram);

  /// Datagrams that were left out, as they were sealed and could not be opened.
  [[nodiscard]] std::uint64_t unread() const noexcept { return unread_; }
  /// Lines for the user: how many, of whom, suite and epoch; empty where none was sealed.
  [[nodiscard]] std::string summary() const;

 private:
  /// By which they are counted.
  struct Kind {
    peer::Sealer sealer;
    peer::SealingSuite suite;
    std::uint16_t epoch;
    auto operator<=>(const Kind&) const = default;
  };
  struct Count {
    std::uint64_t datagrams = 0, opened = 0, greetings = 0;
    std::optional<std::uint8_t> exercise;  ///< for which it sealed what was opened
  };
  /// Of whom a key was made; the last one is kept.
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
  std::uint8_t exercise_ = 1;  // of the last one that was opened
  std::vector<std::byte> plain_;
  std::uint64_t unread_ = 0;
};

}  // namespace reckon::tools

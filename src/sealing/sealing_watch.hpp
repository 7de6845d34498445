// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user about datagrams that a sealed link refuses: rarely, and in one line.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/envelope_opener.hpp"

namespace reckon::peer {

/// A report.
struct SealingNews {
  enum class Kind : std::uint8_t {
    forged,         ///< more than 100 wrong tags in a second
    other_key,      ///< only wrong tags, for 3 s: others have another key file
    unknown_epoch,  ///< for 3 s
    plain,          ///< a datagram that is not sealed
    unanswered,     ///< a sender that does not send our nonce back, for 3 s
  };
  Kind kind = Kind::forged;
  IpEndpoint source;  ///< of the last such datagram
  std::uint64_t count = 0;
  std::uint16_t epoch = 0;
  Sealer sealer;

  /// One line, with the remedy.
  [[nodiscard]] std::string text() const;
};

/// Watches refused datagrams. The reader calls look(), and one more thread may read the ring. No
/// allocation after construction.
class SealingWatch {
 public:
  SealingWatch() : news_(64) {}

  /// Takes each datagram with its verdict.
  void look(const OpenedDatagram& opened, const IpEndpoint& from,
            std::chrono::nanoseconds now) noexcept;
  /// Call it some times a second.
  void tick(std::chrono::nanoseconds now) noexcept;

  [[nodiscard]] haptics::SpscRing<SealingNews>& news() noexcept { return news_; }

 private:
  /// A condition that has to last before it is reported, once a minute.
  struct Lasting {
    std::chrono::nanoseconds first{-1}, reported{-1};
    [[nodiscard]] bool turn(std::chrono::nanoseconds now, std::chrono::nanoseconds span) noexcept;
  };

  void tell(SealingNews::Kind kind, const OpenedDatagram& opened, const IpEndpoint& from) noexcept;
  void look_at_forged(const OpenedDatagram& opened, const IpEndpoint& from,
                      std::chrono::nanoseconds now) noexcept;

  haptics::SpscRing<SealingNews> news_;
  Lasting other_key_, unknown_epoch_, plain_, unanswered_;
  bool has_opened_ = false;
  std::chrono::nanoseconds second_{0};
  std::uint64_t forged_in_second_ = 0;
  IpEndpoint forger_;
};

}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a user has to know of datagrams that a sealed link refuses: rarely, and in one line.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/envelope_opener.hpp"

namespace reckon::peer {

/// Something to tell.
struct SealingNews {
  enum class Kind : std::uint8_t {
    forged,         ///< more than 100 wrong tags in a second
    other_key,      ///< wrong tags only, for 3 s: others have another key file
    unknown_epoch,  ///< for 3 s
    plain,          ///< something that is not sealed
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

/// Looks at what is refused. The reader looks and the ring's other side is for one thread more. No
/// allocation after construction.
class SealingWatch {
 public:
  SealingWatch() : news_(64) {}

  /// Each datagram with its verdict.
  void look(const OpenedDatagram& opened, const IpEndpoint& from,
            std::chrono::nanoseconds now) noexcept;
  /// Some times a second.
  void tick(std::chrono::nanoseconds now) noexcept;

  [[nodiscard]] haptics::SpscRing<SealingNews>& news() noexcept { return news_; }

 private:
  /// Something that has to last before it is reported, and is reported once a minute.
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

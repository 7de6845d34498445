// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How an epoch proves without a key that it is the same as before: each announcement opens the
// commitment of the one before. A receiver of all announcements cannot forge the next one.
//
//   link 255 --H--> link 254 --H--> .. --H--> link 0 --H--> anchor     drawn from a secret, sent
//   the
//                                                                      other way round
//
// A chain has 256 links. Each announcement also contains the anchor of the next chain.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

using pdu::ChainLink;

/// A one-way function: nobody finds an argument for a value. `number` distinguishes its uses.
using OneWay = ChainLink (*)(const ChainLink& link, std::uint32_t number) noexcept;

/// Links of one chain.
inline constexpr std::uint32_t kChainLength = 256;

/// Our own chain. About 256 calls of the function at construction and after each 256 announcements.
class LifeChain {
 public:
  /// @param one_way null: no proofs  @param secret random, never sent
  LifeChain(OneWay one_way, const ChainLink& secret) noexcept;

  /// Fills in the proof of the next announcement.
  void sign(pdu::Presence& announced) noexcept;

 private:
  using Links = std::array<ChainLink, kChainLength>;
  void make(Links& links, std::uint32_t chain) const noexcept;

  OneWay one_way_;
  ChainLink secret_;
  std::uint32_t number_ = 0;  // of the next announcement
  Links links_{}, next_{};    // of this chain, and the one after it
};

/// Result of judging the proof of an announcement.
enum class Opening : std::uint8_t {
  none,   ///< the epoch has offered no proof yet
  newer,  ///< it opens the last received commitment
  known,  ///< a link that was received already, or an earlier one
  wrong,  ///< not from this epoch
};

/// The last accepted announcement of an epoch. A value type.
class LifeTip {
 public:
  LifeTip() = default;
  LifeTip(const pdu::Presence& heard, std::chrono::nanoseconds now) noexcept
      : number_(heard.chain_number),
        link_(heard.chain_link),
        next_anchor_(heard.next_anchor),
        heard_(now) {}

  /// Whether it has offered a proof.
  [[nodiscard]] bool is_chained() const noexcept { return link_ != ChainLink{}; }
  /// Largest number of announcements since the last accepted one, if all others were lost.
  [[nodiscard]] std::uint32_t farthest(std::chrono::nanoseconds now) const noexcept;
  /// Judges an announcement. It needs one call of the function for each announcement in between.
  /// @param most calls; an announcement farther ahead is wrong
  [[nodiscard]] Opening judge(const pdu::Presence& heard, OneWay one_way,
                              std::uint32_t most) const noexcept;

 private:
  std::uint32_t number_ = 0;
  ChainLink link_{}, next_anchor_{};
  std::chrono::nanoseconds heard_{0};
};

}  // namespace reckon::aoim

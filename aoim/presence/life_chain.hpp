// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a life proves without a key that it is the one that was heard before: each announcement opens
// what the one before it was bound to. Whoever has heard all of them cannot say the next one.
//
//   link 255 --H--> link 254 --H--> .. --H--> link 0 --H--> anchor     drawn from a secret, said the
//                                                                      other way round
//
// A chain has 256 links; each announcement also says the anchor of the next chain.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

using pdu::ChainLink;

/// A one-way function: nobody finds an argument for a value. `number` tells its uses apart.
using OneWay = ChainLink (*)(const ChainLink& link, std::uint32_t number) noexcept;

/// Links of one chain.
inline constexpr std::uint32_t kChainLength = 256;

/// Our own chain. Some 256 calls of the function at construction and again each 256 announcements.
class LifeChain {
 public:
  /// @param one_way null: nothing is proved  @param secret drawn at random, never said
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

/// What an announcement says of its proof.
enum class Opening : std::uint8_t {
  none,   ///< the life has offered no proof yet
  newer,  ///< it opens what was heard last
  known,  ///< what has been heard already, or something before it
  wrong,  ///< somebody else says it
};

/// The last announcement of a life that was believed. A value.
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
  /// How far ahead its next announcement may be by now, if all between were lost.
  [[nodiscard]] std::uint32_t farthest(std::chrono::nanoseconds now) const noexcept;
  /// Judges an announcement, with as many calls of the function as it is ahead. @param most calls;
  /// what is farther ahead is wrong
  [[nodiscard]] Opening judge(const pdu::Presence& heard, OneWay one_way,
                              std::uint32_t most) const noexcept;

 private:
  std::uint32_t number_ = 0;
  ChainLink link_{}, next_anchor_{};
  std::chrono::nanoseconds heard_{0};
};

}  // namespace reckon::aoim

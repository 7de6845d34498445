// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/life_chain.hpp"

#include <algorithm>

#include "reckon/aoim/presence/address_proof.hpp"

namespace reckon::aoim {
namespace {

using std::chrono::nanoseconds;

// Uses of the function for secrets of chains; numbers of links are below.
constexpr std::uint32_t kSecrets = 0x8000'0000;
// Time without announcements that slots count at most: receivers can bridge that many links.
constexpr std::chrono::seconds kLongestPause{8};

}  // namespace

ChainLink follow_links(ChainLink link, std::uint32_t number, std::uint32_t to,
                       OneWay one_way) noexcept {
  for (; number > to; --number) link = one_way(link, number);
  return link;
}

LifeChain::LifeChain(const ProofFunctions& functions, const ChainLink& secret) noexcept
    : functions_(functions), secret_(secret) {
  if (functions_.one_way == nullptr) return;
  make(tops_, 0);
  make(next_, 1);
  next_anchor_ = functions_.one_way(link(kChainLength), kChainLength);
}

void LifeChain::make(Tops& tops, std::uint32_t chain) const noexcept {
  ChainLink value = functions_.one_way(secret_, kSecrets | chain);
  for (std::uint32_t slot = kChainLength / kSlotLinks; slot-- > 0;) {
    tops[slot] = value;
    const std::uint32_t top = chain * kChainLength + slot * kSlotLinks + kSlotLinks - 1;
    if (slot > 0) value = follow_links(value, top, top - kSlotLinks, functions_.one_way);
  }
}

ChainLink LifeChain::link(std::uint32_t number) const noexcept {
  const Tops& tops = number / kChainLength == chain_ ? tops_ : next_;
  const std::uint32_t slot = slot_of(number);
  return follow_links(tops[slot_of(number % kChainLength)], slot * kSlotLinks + kSlotLinks - 1,
                      number, functions_.one_way);
}

// Receivers that have received the last announcement can open the next one, however long this
// process was suspended in between.
void LifeChain::advance(nanoseconds now) noexcept {
  if (signed_ == nanoseconds::min()) signed_ = now;
  time_ += std::clamp<nanoseconds>(now - signed_, nanoseconds(0), kLongestPause);
  signed_ = now;
  const std::uint32_t first = static_cast<std::uint32_t>(time_ / kSlot) * kSlotLinks;
  number_ = std::clamp(next_number_, first, first + kSlotLinks - 1);
  next_number_ = number_ + 1;
  if (number_ / kChainLength == chain_) return;
  chain_ = number_ / kChainLength;
  tops_ = next_;
  make(next_, chain_ + 1);
  const std::uint32_t after = (chain_ + 1) * kChainLength;
  next_anchor_ = functions_.one_way(link(after), after);
}

void LifeChain::sign(pdu::Presence& announced, const SourceAddress& source,
                     nanoseconds now) noexcept {
  if (functions_.one_way == nullptr) return;
  advance(now);
  const std::uint32_t slot = slot_of(number_);
  announced.chain_number = number_;
  announced.slot_time = static_cast<std::uint32_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(slot_time()).count());
  announced.chain_link = link(number_);
  announced.next_anchor = next_anchor_;
  announced.address_mac = {};
  if (functions_.keyed_hash == nullptr || source.port == 0) return;
  announced.address_mac =
      address_mac(link((slot + 1) * kSlotLinks), slot,
                  address_digest(announced, source, functions_.keyed_hash), functions_);
}

std::uint32_t LifeTip::farthest(nanoseconds now) const noexcept {
  // Datagrams of several seconds are received at once after a suspension, and some were lost.
  constexpr std::int64_t kSpare = 10 * kSlotLinks, kEachSecond = kSlotLinks + 8;
  const auto seconds = std::max<std::int64_t>((now - heard_) / std::chrono::seconds(1), 0);
  return static_cast<std::uint32_t>(
      std::min<std::int64_t>(kSpare + kEachSecond * seconds, kChainLength));
}

Opening LifeTip::judge(const pdu::Presence& heard, OneWay one_way,
                       std::uint32_t most) const noexcept {
  if (!is_chained() || one_way == nullptr) return Opening::none;
  if (heard.chain_number <= number_) {
    const bool other = heard.chain_number == number_ && heard.chain_link != link_;
    return other ? Opening::wrong : Opening::known;
  }
  const std::uint32_t chain = number_ / kChainLength, said = heard.chain_number / kChainLength;
  if (said - chain > 1 || heard.chain_number - number_ > most) return Opening::wrong;
  const std::uint32_t to = said == chain ? number_ : said * kChainLength;
  ChainLink value = follow_links(heard.chain_link, heard.chain_number, to, one_way);
  if (said != chain) value = one_way(value, to);
  return value == (said == chain ? link_ : next_anchor_) ? Opening::newer : Opening::wrong;
}

}  // namespace reckon::aoim

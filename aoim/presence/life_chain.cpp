// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/life_chain.hpp"

#include <algorithm>

namespace reckon::aoim {
namespace {

// Uses of the function for secrets of chains; numbers of links are below.
constexpr std::uint32_t kSecrets = 0x8000'0000;

}  // namespace

LifeChain::LifeChain(OneWay one_way, const ChainLink& secret) noexcept
    : one_way_(one_way), secret_(secret) {
  if (one_way_ == nullptr) return;
  make(links_, 0);
  make(next_, 1);
}

void LifeChain::make(Links& links, std::uint32_t chain) const noexcept {
  links.back() = one_way_(secret_, kSecrets | chain);
  for (std::uint32_t i = kChainLength - 1; i > 0; --i)
    links[i - 1] = one_way_(links[i], chain * kChainLength + i);
}

void LifeChain::sign(pdu::Presence& announced) noexcept {
  if (one_way_ == nullptr) return;
  const std::uint32_t chain = number_ / kChainLength, step = number_ % kChainLength;
  if (step == 0 && number_ > 0) {
    links_ = next_;
    make(next_, chain + 1);
  }
  announced.chain_number = number_++;
  announced.chain_link = links_[step];
  announced.next_anchor = one_way_(next_[0], (chain + 1) * kChainLength);
}

std::uint32_t LifeTip::farthest(std::chrono::nanoseconds now) const noexcept {
  constexpr std::int64_t kSpare = 16, kEachSecond = 12;  // one each 100 ms at most
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
  const std::uint32_t from = said == chain ? number_ + 1 : said * kChainLength;
  ChainLink value = heard.chain_link;
  for (std::uint32_t i = heard.chain_number; i >= from; --i) value = one_way(value, i);
  return value == (said == chain ? link_ : next_anchor_) ? Opening::newer : Opening::wrong;
}

}  // namespace reckon::aoim

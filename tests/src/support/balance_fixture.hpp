// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A balance of datagrams, and datagrams for it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>

#include "reckon/peer/network/datagram_balance.hpp"
#include "reckon/tests/src/support/udp_on_loopback.hpp"

namespace reckon::peer::balances {

using namespace std::chrono_literals;

inline constexpr std::uint32_t kLife = 77;

inline DatagramEvent event(DatagramFate fate, std::uint32_t number = 0) {
  DatagramEvent event;
  event.group = reckon::test::group(1);
  event.epoch = kLife;
  event.sequence = number;
  event.fate = fate;
  return event;
}

class DatagramBalances : public testing::Test {
 protected:
  void arrive(std::initializer_list<std::uint32_t> numbers) {
    for (const std::uint32_t number : numbers) balance_.take(event(DatagramFate::arrived, number));
  }
  [[nodiscard]] Stretch only_stretch() {
    const BalanceReport report = balance_.report(0s, true);
    EXPECT_EQ(report.stretches.size(), 1u);
    return report.stretches.empty() ? Stretch{} : report.stretches.front();
  }
  /// Everything in the tap, by fate.
  [[nodiscard]] std::array<std::uint64_t, kFates> counts() {
    balance_.look();
    std::array<std::uint64_t, kFates> sums{};
    for (const FateCounts& row : balance_.report(0s, true).fates) {
      EXPECT_EQ(row.key.epoch, kLife);
      for (std::size_t i = 0; i < kFates; ++i) sums[i] += row.counts[i];
    }
    return sums;
  }
  static std::uint64_t of(const std::array<std::uint64_t, kFates>& counts, DatagramFate fate) {
    return counts[static_cast<std::size_t>(fate)];
  }

  DatagramTap tap_;
  DatagramBalance balance_{tap_};
};

}  // namespace reckon::peer::balances

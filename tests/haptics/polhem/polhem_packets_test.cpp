// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/polhem/polhem_packets.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace reckon::haptics {
namespace {

using Octets = std::vector<std::uint8_t>;

// Written by hand: words with the low octet first.
TEST(PolhemPackets, ReadsAReportOfFourteenOctets) {
  const Octets octets{1, 0, 0xFF, 0xFF, 0x34, 0x12, 0x05, 0, 0x06, 0, 0xF9, 0xFF, 1, 0};
  const auto report = polhem_report(PolhemForm::fourteen, octets);
  ASSERT_TRUE(report);
  EXPECT_EQ(*report, (PolhemReport{{1, -1, 0x1234}, {-7, 6, 5}, 1, false}));
}

TEST(PolhemPackets, ReadsTheButtonFromTheOutermostCount) {
  const auto pressed = [](std::int16_t told) {
    Octets octets(14, 0);
    octets[6] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(told) & 0xFF);
    octets[7] = static_cast<std::uint8_t>(static_cast<std::uint16_t>(told) >> 8);
    return *polhem_report(PolhemForm::fourteen, octets);
  };
  EXPECT_EQ(pressed(9'988), (PolhemReport{{}, {0, 0, -12}, 0, true}));
  EXPECT_EQ(pressed(10'300), (PolhemReport{{}, {0, 0, 300}, 0, true}));
  EXPECT_EQ(pressed(-12), (PolhemReport{{}, {0, 0, -12}, 0, false}));
  EXPECT_EQ(pressed(5'000), (PolhemReport{{}, {0, 0, 5'000}, 0, false}));
}

TEST(PolhemPackets, ReadsAReportOfEightOctets) {
  const Octets octets{1, 0, 0xFF, 0xFF, 0x00, 0x80, 0xFE, 0xFF};
  EXPECT_EQ(polhem_report(PolhemForm::eight, octets),
            (PolhemReport{{1, -1, -32768}, {}, 0xFFFE, false}));
}

TEST(PolhemPackets, RefusesEveryOtherLength) {
  for (std::size_t length = 0; length <= 64; ++length) {
    const Octets octets(length, 1);
    EXPECT_EQ(polhem_report(PolhemForm::fourteen, octets).has_value(), length == 14) << length;
    EXPECT_EQ(polhem_report(PolhemForm::eight, octets).has_value(), length == 8) << length;
  }
}

TEST(PolhemPackets, WritesCurrentsAndCounts) {
  EXPECT_EQ(octets_of(PolhemCommand{}), (std::array<std::uint8_t, 14>{}));
  EXPECT_EQ(octets_of(PolhemCommand{{1, -1, 0x1234}, {}}),
            (std::array<std::uint8_t, 14>{1, 0, 0xFF, 0xFF, 0x34, 0x12}));
  // With counts there are no currents: the words of the gimbal take their place.
  EXPECT_EQ(octets_of(PolhemCommand{{9, 9, 9}, std::array<std::int16_t, 6>{1, 2, -5000, 4, 5, 6}}),
            (std::array<std::uint8_t, 14>{4, 0, 5, 0, 6, 0, 1, 0, 1, 0, 2, 0, 0x78, 0xEC}));
}

TEST(PolhemPackets, RestoresTheReportsOfADevice) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> any(-32768, 32767), gimbal(-1024, 1024);
  for (int i = 0; i < 1'000; ++i) {
    std::array<std::int16_t, 7> words{};
    for (std::int16_t& word : words) word = static_cast<std::int16_t>(any(random));
    words[3] = static_cast<std::int16_t>(gimbal(random));
    Octets octets;
    for (const std::int16_t word : words) {
      octets.push_back(static_cast<std::uint8_t>(word & 0xFF));
      octets.push_back(static_cast<std::uint8_t>((word >> 8) & 0xFF));
    }
    const auto report = polhem_report(PolhemForm::fourteen, octets);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->arm, (std::array<std::int16_t, 3>{words[0], words[1], words[2]}));
    EXPECT_EQ(report->gimbal, (std::array<std::int16_t, 3>{words[5], words[4], words[3]}));
    EXPECT_EQ(report->info, static_cast<std::uint16_t>(words[6]));
  }
}

}  // namespace
}  // namespace reckon::haptics

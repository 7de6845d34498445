// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_packets.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/usb/usb_line.hpp"

namespace reckon::haptics {
namespace {

std::vector<FalconReport> reports_of(FalconReportParser& parser, std::string_view text) {
  std::vector<FalconReport> all;
  for (const char c : text) {
    if (const auto report = parser.take(static_cast<std::uint8_t>(c))) all.push_back(*report);
  }
  return all;
}

std::string text_of(const FalconCommand& command) {
  const auto octets = octets_of(command);
  return {octets.begin(), octets.end()};
}

// Written by hand: 1 = BAAA, -1 = PPPP, 0x1234 = EDCB, and so on.
TEST(FalconPackets, WritesACommandAsLetters) {
  EXPECT_EQ(text_of({}), "<AAAAAAAAAAAAAA>");
  EXPECT_EQ(text_of({{1, -1, 0x1234}, 0, false}), "<BAAAPPPPEDCBAA>");
  EXPECT_EQ(text_of({{-32768, 32767, 0}, 0, false}), "<AAAIPPPHAAAAAA>");
  EXPECT_EQ(text_of({{}, 0, true}), "<AAAAAAAAAAAABA>");
  EXPECT_EQ(text_of({{}, 2 + 4, false}), "<AAAAAAAAAAAAGA>");
  EXPECT_EQ(text_of({{}, 2 + 4 + 8, true}), "<AAAAAAAAAAAAPA>");
  EXPECT_EQ(text_of({{}, 0xFF, false}), "<AAAAAAAAAAAAOA>");  // other bits are no lights
}

TEST(FalconPackets, ReadsAReportFromLetters) {
  FalconReportParser parser;
  // Flags: 'A' + 16 * 7 homed + 5 buttons.
  const std::string text =
      std::string("<BAAAPPPPEDCB") + static_cast<char>('A' + 16 * 7 + 5) + "A>";
  const auto reports = reports_of(parser, text);
  ASSERT_EQ(reports.size(), 1U);
  EXPECT_EQ(reports[0], (FalconReport{{1, -1, 0x1234}, 5, 7}));
  EXPECT_EQ(parser.malformed(), 0U);
}

TEST(FalconPackets, AssemblesReportsFromAnyPieces) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> word(-32768, 32767), flags(0, 0x7F), piece(1, 40);
  std::string all;
  std::vector<FalconReport> wanted;
  for (int i = 0; i < 2'000; ++i) {
    FalconReport report;
    std::string text = "<";
    for (auto& count : report.counts) {
      count = static_cast<std::int16_t>(word(random));
      for (int k = 0; k < 4; ++k)
        text += static_cast<char>('A' + ((static_cast<std::uint16_t>(count) >> (4 * k)) & 15));
    }
    const int f = flags(random);
    report.buttons = static_cast<std::uint8_t>(f & 15);
    report.homed = static_cast<std::uint8_t>(f >> 4);
    all += text + static_cast<char>('A' + f) + "A>";
    wanted.push_back(report);
  }
  // As sent by an FTDI chip: pieces of at most 62 octets, each after two octets of status.
  FalconReportParser parser;
  std::vector<FalconReport> read;
  for (std::size_t at = 0; at < all.size();) {
    std::vector<std::uint8_t> transfer;
    for (int packet = 0; packet < 2 && at < all.size(); ++packet) {
      const auto n = std::min<std::size_t>(
          packet == 0 ? 62 : static_cast<std::size_t>(piece(random)), all.size() - at);
      transfer.insert(transfer.end(), {'<', '>'});  // status may have any value
      transfer.insert(transfer.end(), all.begin() + static_cast<std::ptrdiff_t>(at),
                      all.begin() + static_cast<std::ptrdiff_t>(at + n));
      at += n;
      if (n < 62) break;
    }
    each_payload_octet(transfer, kFalconHeader, [&](std::uint8_t octet) {
      if (const auto report = parser.take(octet)) read.push_back(*report);
    });
  }
  EXPECT_EQ(read, wanted);
  EXPECT_EQ(parser.malformed(), 0U);
}

TEST(FalconPackets, DropsDamagedReportsAndFindsTheNext) {
  const std::string good = "<AAAAAAAAAAAAAA>";
  FalconReportParser parser;
  EXPECT_EQ(reports_of(parser, "rubbish>" + good).size(), 1U);
  EXPECT_EQ(parser.malformed(), 0U);                                     // no report had begun
  EXPECT_EQ(reports_of(parser, "<AAAA" + good).size(), 1U);              // truncated
  EXPECT_EQ(reports_of(parser, "<AAAAAAAAAAAAAAA>" + good).size(), 1U);  // too long
  // not a letter of four bits
  EXPECT_EQ(reports_of(parser, "<AAAAAQAAAAAAAA>" + good).size(), 1U);
  EXPECT_EQ(reports_of(parser,
                       "<AAAAAAAAAAAA\xC1"
                       "A>" +
                           good)
                .size(),
            1U);  // invalid flags
  EXPECT_EQ(parser.malformed(), 4U);
  EXPECT_EQ(reports_of(parser, "<AAAAAAA").size(), 0U);
  parser.restart();
  EXPECT_EQ(reports_of(parser, "AAAAAAA>" + good).size(), 1U);
  EXPECT_EQ(parser.malformed(), 4U);
}

TEST(FalconPackets, EmptyOrShortTransferHasNoReport) {
  const std::vector<std::uint8_t> status{0x01, 0x60};
  int count = 0;
  each_payload_octet(std::span(status).first(0), kFalconHeader, [&](std::uint8_t) { ++count; });
  each_payload_octet(std::span(status).first(1), kFalconHeader, [&](std::uint8_t) { ++count; });
  each_payload_octet(status, kFalconHeader, [&](std::uint8_t) { ++count; });
  EXPECT_EQ(count, 0);
}

}  // namespace
}  // namespace reckon::haptics

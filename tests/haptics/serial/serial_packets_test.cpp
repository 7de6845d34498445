// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets worked out by hand, or by independently published rules of COBS and of the CRC.
#include "reckon/haptics/serial/serial_packets.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/serial/serial_frames.hpp"

namespace reckon::haptics {
namespace {

using Octets = std::vector<std::uint8_t>;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Octets frame_octets(const Octets& carried) {
  const SerialFrame frame = serial_frame(carried);
  const auto span = frame.span();
  return {span.begin(), span.end()};
}

std::vector<Octets> frames_in(SerialFrameParser& parser, const Octets& line) {
  std::vector<Octets> all;
  for (const std::uint8_t octet : line) {
    const auto carried = parser.take(octet);
    if (!carried.empty()) all.emplace_back(carried.begin(), carried.end());
  }
  return all;
}

// The check value of the catalogue of parametrised CRC algorithms.
TEST(SerialFrames, CrcMatchesTheCatalogue) {
  const std::string_view check = "123456789";
  EXPECT_EQ(serial_crc({reinterpret_cast<const std::uint8_t*>(check.data()), check.size()}),
            0x29B1);
}

// CRCs by Python's binascii.crc_hqx(octets, 0xFFFF), low octet first; COBS by hand.
TEST(SerialFrames, FollowTheRulesOfCobsAndCrc) {
  EXPECT_THAT(frame_octets({0x11, 0x22}), ElementsAre(0, 5, 0x11, 0x22, 0x6D, 0x29, 0));
  EXPECT_THAT(frame_octets({0x11, 0x00, 0x22}), ElementsAre(0, 2, 0x11, 4, 0x22, 0xEF, 0xBC, 0));
  EXPECT_THAT(frame_octets({0x00}), ElementsAre(0, 1, 3, 0xF0, 0xE1, 0));
}

TEST(SerialFrames, AreReadFromAnyPiecesAndContents) {
  std::mt19937 random(3);
  SerialFrameParser parser;
  for (int i = 0; i < 5'000; ++i) {
    Octets carried(1 + random() % kSerialMost);
    for (auto& octet : carried) octet = random() % 3 == 0 ? 0 : static_cast<std::uint8_t>(random());
    EXPECT_THAT(frames_in(parser, frame_octets(carried)), ElementsAre(carried));
  }
  EXPECT_EQ(parser.damaged(), 0U);
}

TEST(SerialFrames, DamagedOctetCostsAtMostTwoFrames) {
  std::mt19937 random(4);
  const Octets carried{0x82, 1, 0, 0, 7, 0x55};
  Octets line;
  for (int i = 0; i < 5; ++i) {
    const Octets frame = frame_octets(carried);
    line.insert(line.end(), frame.begin(), frame.end());
  }
  for (std::size_t at = 0; at < line.size(); ++at) {
    for (unsigned change = 0; change <= 256; ++change) {
      Octets damaged = line;
      if (change == 256)
        damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(at));
      else
        damaged[at] ^= static_cast<std::uint8_t>(change);
      SerialFrameParser parser;
      const auto read = frames_in(parser, damaged);
      ASSERT_GE(read.size(), 3U) << at << " " << change;
      for (const Octets& frame : read) ASSERT_EQ(frame, carried) << at << " " << change;
    }
  }
}

TEST(SerialFrames, OverlongFrameIsDroppedAndTheNextRead) {
  SerialFrameParser parser;
  Octets line(10'000, 0x41);
  const Octets frame = frame_octets({1, 2, 3});
  line.insert(line.end(), frame.begin(), frame.end());
  EXPECT_THAT(frames_in(parser, line), ElementsAre(Octets{1, 2, 3}));
  EXPECT_EQ(parser.damaged(), 1U);
}

// Struct "<BHIHHBBiii" of Python.
const Octets kReport{0x82, 0x34, 0x12, 0x15, 0xCD, 0x5B, 0x07, 0x02, 0x01, 0x03, 0x01, 0x03, 0x09,
                     0x01, 0x00, 0x00, 0x00, 0xFF, 0xFF, 0xFF, 0xFF, 0x00, 0x00, 0x00, 0x80};

TEST(SerialPackets, ReportIsReadFromItsOctets) {
  const auto report = serial_report(kReport, 3);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->sequence, 0x1234);
  EXPECT_EQ(report->stamp, 123'456'789U);
  EXPECT_EQ(report->until, 0x0102);
  EXPECT_EQ(report->from, 0x0103);
  EXPECT_TRUE(report->homed);
  EXPECT_EQ(report->force_drops, 0);
  EXPECT_EQ(report->buttons, 9);
  EXPECT_THAT(report->counts, ElementsAre(1, -1, -2'147'483'648));
  Octets none = kReport;
  none[11] = 4 + 16 * 9;
  EXPECT_EQ(serial_report(none, 3)->until, std::nullopt);
  EXPECT_EQ(serial_report(none, 3)->from, std::nullopt);
  EXPECT_FALSE(serial_report(none, 3)->homed);
  EXPECT_EQ(serial_report(none, 3)->force_drops, 9);
}

TEST(SerialPackets, OtherLengthKindOrFlagIsNoReport) {
  for (std::size_t length = 0; length <= kReport.size() + 1; ++length) {
    Octets cut = kReport;
    cut.resize(length);
    for (std::size_t axes = 1; axes <= 3; ++axes)
      EXPECT_EQ(serial_report(cut, axes).has_value(), length == 13 + 4 * axes);
  }
  Octets other = kReport;
  other[0] = 0x81;
  EXPECT_FALSE(serial_report(other, 3));
  other = kReport;
  other[11] = 8;
  EXPECT_FALSE(serial_report(other, 3)) << "a flag of a later version";
}

TEST(SerialPackets, WritesForceAndQuestionFrames) {
  SerialFrameParser parser;
  const auto carried_by = [&](const SerialFrame& frame) {
    return frames_in(parser, {frame.span().begin(), frame.span().end()}).at(0);
  };
  EXPECT_THAT(carried_by(ask_frame(0xABCD)), ElementsAre(1, 1, 0xCD, 0xAB));
  EXPECT_THAT(carried_by(frame_of({0x0102, {1000, -2, 0}}, 3)),
              ElementsAre(2, 0x02, 0x01, 0xE8, 0x03, 0xFE, 0xFF, 0, 0));
  EXPECT_THAT(carried_by(frame_of({7, {-1, 0, 0}}, 1)), ElementsAre(2, 7, 0, 0xFF, 0xFF));
}

// A paddle along x, of 14,700 nm a count and 3 N.
const Octets kPaddle{0x81, 1, 0x34, 0x12, 1,   10,  0xE8, 0x03, 0,   0x6C, 0x39,
                     0,    0, 0xB8, 0x0B, 'H', 'a', 'p',  'k',  'i', 't'};

// The frames of docs/devices.md, made by a Python script from the text alone.
TEST(SerialPackets, FramesMatchTheDocumentation) {
  const auto octets = [](const SerialFrame& frame) {
    return Octets(frame.span().begin(), frame.span().end());
  };
  EXPECT_EQ(octets(ask_frame(0x1234)), (Octets{0, 7, 1, 1, 0x34, 0x12, 0x66, 0x3e, 0}));
  EXPECT_EQ(octets(frame_of({5, {-250, 0, 0}}, 1)),
            (Octets{0, 3, 2, 5, 5, 6, 0xff, 0x9c, 0x5d, 0}));
  SerialFrameParser parser;
  const auto carried =
      frames_in(parser, {0,    9, 0x81, 1,    0x34, 0x12, 1,    0x0a, 0xe8, 3,    3,   0x6c,
                         0x39, 1, 0x0b, 0xb8, 0x0b, 'P',  'a',  'd',  'd',  'l',  'e', 0xb2,
                         0x58, 0, 0,    3,    0x82, 7,    4,    0x40, 0x42, 0x0f, 2,   4,
                         2,    5, 2,    3,    7,    0xf9, 0xff, 0xff, 0xff, 0xc8, 3,   0});
  ASSERT_EQ(carried.size(), 2U);
  const auto greeting = serial_greeting(carried[0]);
  ASSERT_TRUE(greeting);
  EXPECT_EQ(greeting->axis[0], (SerialAxis{0, 14'700, 3'000}));
  const auto report = serial_report(carried[1], 1);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->sequence, 7);
  EXPECT_EQ(report->stamp, 1'000'000U);
  EXPECT_EQ(report->until, 4);
  EXPECT_EQ(report->from, 5);
  EXPECT_EQ(report->counts[0], -7);
}

TEST(SerialPackets, GreetingIsReadFromItsOctets) {
  const auto greeting = serial_greeting(kPaddle);
  ASSERT_TRUE(greeting);
  EXPECT_EQ(greeting->answers, 0x1234);
  EXPECT_EQ(greeting->axes, 1);
  EXPECT_EQ(greeting->watchdog, 10);
  EXPECT_EQ(greeting->period, 1000);
  EXPECT_EQ(greeting->axis[0], (SerialAxis{0, 14'700, 3'000}));
  EXPECT_STREQ(greeting->name.data(), "Hapkit");
  EXPECT_THAT(refusal_of(*greeting, 3.0, 14.7e-6), IsEmpty());
}

TEST(SerialPackets, OtherVersionOrNoNameIsNoGreeting) {
  for (std::size_t length = 0; length < kPaddle.size(); ++length) {
    Octets cut = kPaddle;
    cut.resize(length);
    EXPECT_EQ(serial_greeting(cut).has_value(), length > 15) << length;
    EXPECT_EQ(serial_version(cut).has_value(), length > 1) << length;
  }
  Octets other = kPaddle;
  other[1] = 2;
  EXPECT_FALSE(serial_greeting(other));
  EXPECT_EQ(serial_version(other), 2);
  other = kPaddle;
  other.back() = '\n';
  EXPECT_FALSE(serial_greeting(other));
  other = kPaddle;
  other.resize(15 + 33, 'x');
  EXPECT_FALSE(serial_greeting(other)) << "a name of 33 letters";
}

TEST(SerialPackets, UnsuitableBoardIsRefusedWithTheReason) {
  const SerialGreeting good = *serial_greeting(kPaddle);
  const auto refusal = [&](auto change) {
    SerialGreeting other = good;
    change(other);
    return refusal_of(other, 3.0, 14.7e-6);
  };
  EXPECT_THAT(refusal([](auto& board) { board.axes = 4; }), HasSubstr("it has 4 axes"));
  EXPECT_THAT(refusal([](auto& board) { board.axes = 0; }), HasSubstr("it has 0 axes"));
  EXPECT_THAT(refusal([](auto& board) { board.watchdog = 0; }), HasSubstr("after 0 ms"));
  EXPECT_THAT(refusal([](auto& board) { board.watchdog = 11; }), HasSubstr("set it to 1 to 10 ms"));
  EXPECT_THAT(refusal([](auto& board) { board.period = 2001; }), HasSubstr("every 2001 us"));
  EXPECT_THAT(refusal([](auto& board) { board.period = 99; }), HasSubstr("every 99 us"));
  EXPECT_THAT(refusal([](auto& board) { board.axis[0].direction = 3; }), HasSubstr("one has none"));
  EXPECT_THAT(refusal([](auto& board) {
                board.axes = 2;
                board.axis[1] = board.axis[0];
              }),
              HasSubstr("the same direction"));
  EXPECT_THAT(refusal([](auto& board) { board.axis[0].nm_per_count = 0; }), HasSubstr("the step"));
  EXPECT_THAT(refusal([](auto& board) { board.axis[0].nm_per_count = -1'000'001; }),
              HasSubstr("the step"));
  EXPECT_THAT(refusal([](auto& board) { board.axis[0].most_force = 0; }), HasSubstr("no force"));
  EXPECT_THAT(refusal([](auto& board) { board.axis[0].most_force = 2'500; }),
              HasSubstr("max_force = \"2.5 N\""));
  EXPECT_THAT(refusal([](auto& board) { board.axis[0].nm_per_count = -14'701; }),
              HasSubstr("resolution = \"14.701 um\""));
}

}  // namespace
}  // namespace reckon::haptics

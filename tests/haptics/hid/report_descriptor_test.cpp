// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/hid/report_descriptor.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "reckon/tests/haptics/support/pid_wheel.hpp"

namespace reckon::haptics {
namespace {

using Octets = std::vector<std::uint8_t>;

// The boot mouse of the class definition (HID 1.11, E.10): three buttons, padding, X and Y.
const Octets kMouse{0x05, 0x01, 0x09, 0x02, 0xA1, 0x01, 0x09, 0x01, 0xA1, 0x00, 0x05, 0x09, 0x19,
                    0x01, 0x29, 0x03, 0x15, 0x00, 0x25, 0x01, 0x95, 0x03, 0x75, 0x01, 0x81, 0x02,
                    0x95, 0x01, 0x75, 0x05, 0x81, 0x01, 0x05, 0x01, 0x09, 0x30, 0x09, 0x31, 0x15,
                    0x81, 0x25, 0x7F, 0x75, 0x08, 0x95, 0x02, 0x81, 0x06, 0xC0, 0xC0};

TEST(ReportDescriptor, MouseOfTheClassDefinitionHasItsFields) {
  const auto reports = hid_reports(kMouse);
  ASSERT_TRUE(reports);
  ASSERT_EQ(reports->fields.size(), 5U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(reports->fields[i].usage, hid_usage(9, i + 1));
    EXPECT_EQ(reports->fields[i].bit, 8 + i) << "behind the octet of a number";
    EXPECT_EQ(reports->fields[i].bits, 1U);
    EXPECT_EQ(reports->fields[i].most, 1);
  }
  EXPECT_EQ(reports->fields[3].usage, hid_usage(1, 0x30));
  EXPECT_EQ(reports->fields[4].bit, 24U);
  EXPECT_EQ(reports->fields[4].least, -127);
  EXPECT_EQ(reports->fields[4].most, 127);
  EXPECT_EQ(reports->size(HidKind::input, 0), 4U);
  EXPECT_EQ(reports->size(HidKind::output, 0), 0U);
  EXPECT_TRUE(reports->is_within(reports->fields[0].collection, hid_usage(1, 0x02)));
  EXPECT_FALSE(reports->is_within(reports->fields[0].collection, hid_usage(1, 0x04)));
}

TEST(ReportDescriptor, RangeIsSignedIfItBeginsBelowZero) {
  const Octets descriptor{0x05, 0x01, 0x09, 0x04, 0xA1, 0x01, 0x0B, 0x22, 0x00, 0x0F, 0x00,
                          0x15, 0x00, 0x26, 0xFF, 0xFF, 0x75, 0x10, 0x95, 0x01, 0x91, 0x02,
                          0x09, 0x30, 0x16, 0x00, 0x80, 0x26, 0xFF, 0x7F, 0x91, 0x02, 0xC0};
  const auto reports = hid_reports(descriptor);
  ASSERT_TRUE(reports);
  ASSERT_EQ(reports->fields.size(), 2U);
  EXPECT_EQ(reports->fields[0].usage, hid_usage(0x0F, 0x22));
  EXPECT_EQ(reports->fields[0].most, 0xFFFF);
  EXPECT_EQ(reports->fields[1].usage, hid_usage(1, 0x30));
  EXPECT_EQ(reports->fields[1].least, -32768);
  Octets report(reports->size(HidKind::output, 0));
  for (const std::int64_t number : {-32768, -1, 0, 5, 32767}) {
    put_number(report, reports->fields[1], number);
    EXPECT_EQ(number_in(report, reports->fields[1]), number);
  }
  put_number(report, reports->fields[0], 0xFFFF);
  EXPECT_EQ(number_in(report, reports->fields[0]), 0xFFFF);
  EXPECT_EQ(number_in(report, reports->fields[1]), 32767) << "beside it";
}

TEST(ReportDescriptor, NumbersOfAnyWidthAreAdjacent) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 2000; ++i) {
    Octets report(16, static_cast<std::uint8_t>(random()));
    HidField field;
    field.bits = 1 + static_cast<std::uint32_t>(random() % 32);
    field.bit = 8 + static_cast<std::uint32_t>(random() % 80);
    field.least = random() % 2 == 0 ? -(std::int64_t{1} << (field.bits - 1)) : 0;
    const auto number =
        static_cast<std::int64_t>(random() % (std::uint64_t{1} << field.bits)) + field.least;
    const Octets before = report;
    put_number(report, field, number);
    ASSERT_EQ(number_in(report, field), number);
    for (std::uint32_t bit = 0; bit < 128; ++bit) {
      if (bit >= field.bit && bit < field.bit + field.bits) continue;
      ASSERT_EQ(report[bit / 8] >> bit % 8 & 1, before[bit / 8] >> bit % 8 & 1);
    }
  }
  HidField beyond;
  beyond.bit = 120;
  beyond.bits = 9;
  Octets report(16);
  EXPECT_EQ(number_in(report, beyond), std::nullopt);
  put_number(report, beyond, 511);
  EXPECT_EQ(report, Octets(16));
}

TEST(ReportDescriptor, RestoresAPushedState) {
  const Octets descriptor{0x05, 0x01, 0x09, 0x04, 0xA1, 0x01, 0x15, 0x00, 0x25, 0x07,
                          0x75, 0x03, 0x95, 0x01, 0xA4, 0x25, 0x01, 0x75, 0x01, 0x09,
                          0x30, 0x81, 0x02, 0xB4, 0x09, 0x31, 0x81, 0x02, 0xC0};
  const auto reports = hid_reports(descriptor);
  ASSERT_TRUE(reports);
  ASSERT_EQ(reports->fields.size(), 2U);
  EXPECT_EQ(reports->fields[0].bits, 1U);
  EXPECT_EQ(reports->fields[1].bits, 3U);
  EXPECT_EQ(reports->fields[1].most, 7);
}

TEST(ReportDescriptor, RefusesInvalidDescriptors) {
  const Octets end{0xC0}, pop{0xB4}, open{0xA1, 0x01}, bare{0x75, 0x08, 0x95, 0x01, 0x81, 0x02};
  const Octets wide{0xA1, 0x01, 0x77, 0xFF, 0xFF, 0xFF, 0xFF, 0xC0};
  const Octets many{0xA1, 0x01, 0x75, 0x20, 0x96, 0xFF, 0xFF, 0x81, 0x02, 0xC0};
  const Octets numbered{0x85, 0x00, 0xA1, 0x01, 0xC0};  // a report of number 0
  const Octets backwards{0x19, 0x05, 0x29, 0x04};
  const Octets all{0x1B, 0x00, 0x00, 0x00, 0x00, 0x2B, 0xFF, 0xFF, 0xFF, 0xFF};
  const Octets short_long{0xFE, 0x05, 0x00, 0x00};
  for (const Octets& descriptor :
       {end, pop, open, bare, wide, many, numbered, backwards, all, short_long, Octets{}})
    EXPECT_FALSE(hid_reports(descriptor));
  EXPECT_FALSE(hid_reports(Octets(HidReports::kMostOctets + 1, 0xC0)));
  Octets mouse = kMouse;
  mouse.insert(mouse.begin(), {0xFE, 0x02, 0xF0, 0x11, 0x22});  // a long item has no meaning
  EXPECT_TRUE(hid_reports(mouse));
}

TEST(ReportDescriptor, RefusesATruncatedDescriptor) {
  const Octets whole = test::PidWheel({}).descriptor();
  ASSERT_TRUE(hid_reports(whole));
  EXPECT_GT(hid_reports(whole)->fields.size(), 50U);
  for (std::size_t i = 6; i < whole.size(); ++i)  // its collection is open from there
    EXPECT_FALSE(hid_reports(std::span(whole).first(i))) << i;
}

}  // namespace
}  // namespace reckon::haptics

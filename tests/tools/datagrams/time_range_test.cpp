// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// --from and --to of a recording.
#include "reckon/tools/datagrams/time_range.hpp"

#include <gmock/gmock.h>

#include <string>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using test::run_reckon;
using ::testing::HasSubstr;

// 2023-11-14T22:13:20Z.
constexpr nanoseconds kStart = 1'700'000'000s;

nanoseconds from_start(const std::string& text) {
  return RecordingInstant("--from", text).in_recording(kStart) - kStart;
}

TEST(RecordingInstant, IsAnOffsetTimeOfDayOrDate) {
  EXPECT_EQ(from_start("0"), 0s);
  EXPECT_EQ(from_start("2.5"), 2500ms);
  EXPECT_EQ(from_start("90s"), 90s);
  EXPECT_EQ(from_start("1.5min"), 90s);
  EXPECT_EQ(from_start("22:13:20"), 0s);
  EXPECT_EQ(from_start("22:14"), 40s);
  EXPECT_EQ(from_start("22:13:21.25Z"), 1250ms);
  EXPECT_EQ(from_start("2023-11-14T22:13:25Z"), 5s);
  EXPECT_EQ(from_start("2023-11-14 22:13:25.5"), 5500ms);
  EXPECT_EQ(from_start("2023-11-15"), 1h + 46min + 40s);
}

TEST(RecordingInstant, TimesOfDayStartOneHourBeforeBeginning) {
  EXPECT_EQ(from_start("22:00"), -(13min + 20s));
  EXPECT_EQ(from_start("00:10"), 1h + 56min + 40s) << "of the next day";
  EXPECT_EQ(from_start("21:00"), 22h + 46min + 40s) << "of the next day";
}

TEST(RecordingInstant, RefusesOtherTextWithTheRemedy) {
  for (const char* wrong : {"", "-3", "25:00", "12:60", "12:00:60", "2023-02-30", "2023-13-01",
                            "2023-11-14T", "2023-11-14T22:13x", "noon", "1:2", "12:00:00."}) {
    try {
      (void)RecordingInstant("--to", wrong);
      ADD_FAILURE() << wrong;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr("--to ")) << wrong;
      EXPECT_THAT(error.what(), HasSubstr("14:03:20"));
    }
  }
  EXPECT_THROW((void)RecordingInstant("--from", "12:00").in_recording(0s), UsageError);
}

TEST(TimeRange, HasItsBeginAndNotItsEnd) {
  TimeRange range("1", "3");
  range.begin_at(kStart);
  EXPECT_FALSE(range.has(kStart + 999ms));
  EXPECT_TRUE(range.has(kStart + 1s));
  EXPECT_TRUE(range.has(kStart + 2999ms));
  EXPECT_FALSE(range.has(kStart + 3s));
  EXPECT_TRUE(range.is_past(kStart + 3s));
  TimeRange empty("3", "22:13:21");
  EXPECT_THROW(empty.begin_at(kStart), UsageError);
  TimeRange whole("", "");
  whole.begin_at(kStart);
  EXPECT_TRUE(whole.has(kStart - 1h));
}

TEST(InspectRange, ShowsTheRangeInEveryView) {
  test::CaptureBuilder capture;
  for (std::uint16_t i = 0; i < 10; ++i) {
    pdu::EntityState pdu;
    pdu.entity_id = {1, 1, static_cast<std::uint16_t>(i + 1)};
    pdu.location = {6378137, 0, 0};
    test::Octets datagram;
    test::append_pdu(datagram, pdu);
    capture.add(datagram, kStart + std::chrono::seconds(i));
  }
  const std::string file = capture.path();
  const auto tail = run_reckon({"inspect", file, "--from", "2", "--to", "22:13:25"});
  ASSERT_EQ(tail.lines().size(), 4U) << tail.out;
  EXPECT_THAT(tail.lines()[1], HasSubstr("2.000000")) << "since the first datagram of the file";
  EXPECT_THAT(tail.lines()[1], HasSubstr("1:1:3"));
  EXPECT_EQ(run_reckon({"inspect", file, "--json", "--from", "8s", "--where", "time >= 9"})
                .lines()
                .size(),
            1U);
  for (const char* view : {"stats", "check", "bundles", "top", "haptics", "emissions"})
    EXPECT_LE(run_reckon({"inspect", file, view, "--from", "2", "--to", "5"}).status, 1) << view;
  EXPECT_THAT(run_reckon({"inspect", file, "stats", "--json", "--to", "3"}).lines().back(),
              HasSubstr(R"("pdus":3,"datagrams":3)"));
  EXPECT_EQ(run_reckon({"inspect", file, "--from", "5", "--to", "2"}).status, 2);
  const auto live = run_reckon({"inspect", "udp://239.192.1.0", "--from", "5"});
  EXPECT_EQ(live.status, 2);
  EXPECT_THAT(live.err, HasSubstr("--for"));
}

}  // namespace
}  // namespace reckon::tools

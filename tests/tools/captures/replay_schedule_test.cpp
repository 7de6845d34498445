// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The clock of a replay, and its changes to the octets.
#include "reckon/tools/captures/replay_schedule.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tools/captures/timestamp_rewrite.hpp"
#include "reckon/tools/command_line/size_text.hpp"

namespace reckon::tools::replay_schedule_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

/// Returns when a datagram recorded at `time` is due; it is then sent.
nanoseconds play(ReplaySchedule& schedule, nanoseconds time) {
  schedule.next(time);
  const nanoseconds due = schedule.due();
  schedule.sent(due);
  return due;
}

TEST(ReplaySchedule, SendsTheFirstDatagramAtOnce) {
  ReplaySchedule slow(1, 77ns);
  EXPECT_EQ(play(slow, 1'700'000'000s), 77ns);
  ReplaySchedule fast(8, 77ns);
  EXPECT_EQ(play(fast, 0s), 77ns);
}

TEST(ReplaySchedule, StretchesTimeByTheRate) {
  for (const auto& [rate, due] :
       {std::pair{1.0, 10s}, std::pair{2.0, 5s}, std::pair{0.5, 20s}, std::pair{0.0, 0s}}) {
    ReplaySchedule schedule(rate, 100s);
    (void)play(schedule, 1000s);
    EXPECT_EQ(play(schedule, 1010s), 100s + due) << rate;
    EXPECT_EQ(schedule.played(), 10s);
    EXPECT_EQ(schedule.asked(), rate);
    EXPECT_EQ(schedule.kept(), rate);
  }
}

TEST(ReplaySchedule, AddsNoErrorUpOverAMillionDatagrams) {
  // If steps were added up, a third of a nanosecond would be lost in each.
  ReplaySchedule schedule(3.0, 0s);
  nanoseconds due{};
  for (std::int64_t i = 0; i <= 1'000'000; ++i) due = play(schedule, nanoseconds(i * 1000));
  EXPECT_EQ(due, nanoseconds(333'333'333));
}

TEST(ReplaySchedule, SendsLateComersAtTheirOwnTime) {
  ReplaySchedule schedule(1.0, 50s);
  (void)play(schedule, 100s);
  EXPECT_EQ(play(schedule, 103s), 53s);
  EXPECT_EQ(play(schedule, 101s), 51s);  // out of order in the capture
  EXPECT_EQ(schedule.played(), 3s);
}

TEST(ReplaySchedule, SendsDatagramsStampedBeforeTheFirstAtOnce) {
  ReplaySchedule schedule(1.0, 50s);
  (void)play(schedule, 100s);
  schedule.next(40s);
  EXPECT_FALSE(schedule.is_skipped());
  EXPECT_LT(schedule.due(), 50s);
  (void)schedule.seek(-10s, 50s);
  schedule.next(100s);
  schedule.next(40s);
  EXPECT_FALSE(schedule.is_skipped()) << "from the beginning again";
}

TEST(ReplaySchedule, JoinsLapsAtTheMeanSpacing) {
  ReplaySchedule schedule(1.0, 0s);
  std::vector<nanoseconds> due;
  for (int lap = 0; lap < 3; ++lap) {
    for (const nanoseconds time : {100s, 101s, 104s}) due.push_back(play(schedule, time));
    schedule.next_lap(due.back());
  }
  EXPECT_EQ(due, (std::vector<nanoseconds>{0s, 1s, 4s, 6s, 7s, 10s, 12s, 13s, 16s}));
  EXPECT_EQ(schedule.played(), 16s);
}

TEST(ReplaySchedule, RepeatsALoneDatagramOnceASecond) {
  ReplaySchedule schedule(2.0, 0s);
  EXPECT_EQ(play(schedule, 9s), 0s);
  schedule.next_lap(0s);
  EXPECT_EQ(play(schedule, 9s), 500ms);
}

TEST(ReplaySchedule, ReportsTheAchievedRateWhenLate) {
  ReplaySchedule schedule(4.0, 10s);
  (void)play(schedule, 100s);
  schedule.next(108s);
  EXPECT_EQ(schedule.due(), 12s);
  schedule.sent(14s);
  EXPECT_EQ(schedule.asked(), 4);
  EXPECT_EQ(schedule.kept(), 2);
}

template <typename Pdu>
void append(std::vector<std::byte>& datagram, const Pdu& pdu) {
  const std::size_t begin = datagram.size();
  datagram.resize(begin + wire_size(pdu));
  ASSERT_GT(encode(pdu, std::span(datagram).subspan(begin)), 0U);
}

TEST(TimestampRewrite, SetsEveryPduAndNothingElse) {
  const nanoseconds recorded = 1'600'000'000s;
  const nanoseconds now = 1'700'000'123s + 456'789ns;
  pdu::EntityState absolute;
  absolute.header.timestamp = pdu::to_dis_timestamp(recorded, true);
  pdu::EntityState relative;
  relative.header.timestamp = pdu::to_dis_timestamp(recorded, false);
  pdu::DatagramTrailer trailer;
  trailer.header.timestamp = absolute.header.timestamp;
  trailer.send_time = pdu::trailer_time(recorded);
  std::vector<std::byte> datagram;
  append(datagram, absolute);
  append(datagram, relative);
  append(datagram, trailer);
  rewrite_timestamps(datagram, now);

  absolute.header.timestamp = pdu::to_dis_timestamp(now, true);
  relative.header.timestamp = pdu::to_dis_timestamp(now, false);
  trailer.header.timestamp = absolute.header.timestamp;
  trailer.send_time = pdu::trailer_time(now);
  std::vector<std::byte> wanted;
  append(wanted, absolute);
  append(wanted, relative);
  append(wanted, trailer);
  EXPECT_EQ(datagram, wanted);
}

TEST(TimestampRewrite, LeavesBrokenOctetsAlone) {
  std::vector<std::byte> datagram;
  append(datagram, pdu::EntityState{});
  for (std::size_t size = 0; size < datagram.size(); ++size) {
    std::vector<std::byte> cut(datagram.begin(), datagram.begin() + static_cast<long>(size));
    const std::vector<std::byte> before = cut;
    rewrite_timestamps(cut, 1'700'000'000s);
    EXPECT_EQ(cut, before);
  }
}

TEST(SizeText, ReadsSizesWithUnits) {
  EXPECT_EQ(parse_size("500"), 500U);
  EXPECT_EQ(parse_size("1.5k"), 1500U);
  EXPECT_EQ(parse_size("100 MB"), 100'000'000U);
  EXPECT_EQ(parse_size("2GiB"), std::uint64_t{2} << 30);
  for (const char* text : {"", "MB", "0", "-1k", "1T", "nan", "inf", "1e40", "5 apples"})
    EXPECT_FALSE(parse_size(text).has_value()) << text;
  EXPECT_EQ(size_text(999), "999 B");
  EXPECT_EQ(size_text(1'250'000), "1.25 MB");
}

}  // namespace
}  // namespace reckon::tools::replay_schedule_test

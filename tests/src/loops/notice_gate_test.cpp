// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice_gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {
namespace {

using aoim::PresenceEventKind;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using testing::Contains;
using testing::HasSubstr;

aoim::SourceAddress at_host(std::uint32_t host) {
  return source_of(IpEndpoint::v4(0x0a4d0000u + host, 4000));
}

class LinesOfStrangers : public testing::Test {
 protected:
  void happens(PresenceEventKind kind, std::uint32_t host, unsigned peer,
               nanoseconds heard_for = {}) {
    aoim::PresenceEvent event;
    event.kind = kind;
    event.announced.simulation = {700, static_cast<std::uint16_t>(peer)};
    event.source = event.other = at_host(host);
    event.heard_for = heard_for;
    gate_.report(event, now_, ring_);
  }
  // Time passes as in the model loop.
  void pass(nanoseconds length) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(50))
      gate_.look(now_, ring_);
  }
  std::vector<std::string> lines() {
    std::vector<std::string> lines;
    for (; ring_.front() != nullptr; ring_.pop()) lines.emplace_back(ring_.front()->text.data());
    return lines;
  }

  haptics::SpscRing<Notice> ring_{4096};
  NoticeGate gate_;
  nanoseconds now_ = seconds(100);
};

struct Turmoil {
  unsigned peers_a_second;
  unsigned hosts;
};

class RatesOfStrangers : public LinesOfStrangers, public testing::WithParamInterface<Turmoil> {};

TEST_P(RatesOfStrangers, TransientStrangersCauseOneLinePerSecond) {
  constexpr unsigned kSeconds = 20;
  const auto [peers, hosts] = GetParam();
  unsigned caused = 0;
  for (unsigned i = 0; i < kSeconds * 20; ++i) {
    for (unsigned k = 0; k < peers / 20; ++k) {
      happens(PresenceEventKind::newcomer, 1 + k % hosts, i * 1000 + k);
      happens(k % 3 == 0 ? PresenceEventKind::impostor : PresenceEventKind::departed, 1 + k % hosts,
              i * 1000 + k);
      caused += 2;
    }
    pass(milliseconds(50));
  }
  pass(seconds(2));
  const std::size_t groups = std::min<std::size_t>(hosts, NoticeGate::kHosts);
  const std::vector<std::string> told = lines();
  EXPECT_LE(told.size(), groups * (NoticeGate::kAtOnce + kSeconds + 3));
  EXPECT_GE(told.size(), groups * kSeconds / 2) << "and each second some";
  std::size_t counted = 0;
  for (const std::string& line : told)
    counted += line.find("more lines about") == std::string::npos ? 1 : std::stoul(line.substr(8));
  EXPECT_EQ(counted, caused) << "each is told or counted";
}

INSTANTIATE_TEST_SUITE_P(Turmoils, RatesOfStrangers,
                         testing::Values(Turmoil{20, 1}, Turmoil{200, 1}, Turmoil{2000, 7},
                                         Turmoil{4000, 50}));

TEST_F(LinesOfStrangers, ReportsKnownPeersBesideStrangersOfTheirHost) {
  for (unsigned i = 0; i < 500; ++i) happens(PresenceEventKind::newcomer, 1, i);
  static_cast<void>(lines());
  happens(PresenceEventKind::departed, 1, 9001, seconds(60));
  happens(PresenceEventKind::quiet, 1, 9002, seconds(11));
  EXPECT_THAT(lines(), testing::SizeIs(2));
  happens(PresenceEventKind::departed, 1, 9003, seconds(9));
  EXPECT_THAT(lines(), testing::IsEmpty());
}

TEST_F(LinesOfStrangers, StrangersOfOneHostHideNothingOfAnother) {
  for (unsigned i = 0; i < 500; ++i) happens(PresenceEventKind::newcomer, 1, i);
  static_cast<void>(lines());
  happens(PresenceEventKind::newcomer, 2, 1);
  EXPECT_THAT(lines(), Contains(HasSubstr("700:1")));
}

TEST_F(LinesOfStrangers, ReportsEachOfEightSimultaneousNewcomers) {
  for (unsigned i = 0; i < 8; ++i) happens(PresenceEventKind::newcomer, 1, i);
  EXPECT_THAT(lines(), testing::SizeIs(8));
  happens(PresenceEventKind::newcomer, 1, 8);
  pass(milliseconds(900));
  EXPECT_THAT(lines(), testing::IsEmpty());
  pass(milliseconds(200));
  EXPECT_THAT(lines(),
              Contains(HasSubstr("omitted 1 more lines about unknown senders at 10.77.0.1")));
}

TEST_F(LinesOfStrangers, AlwaysReportsEventsOfThisPeer) {
  for (unsigned i = 0; i < 100; ++i) happens(PresenceEventKind::identity_changed, 0, i);
  EXPECT_THAT(lines(), testing::SizeIs(100));
}

TEST_F(LinesOfStrangers, FloodsFromManyPortsCountAsOneHost) {
  for (std::uint16_t port = 1; port < 200; ++port)
    gate_.report({IpEndpoint::v4(0x0a4d0001u, port), port % 2 == 1, 5}, now_, ring_);
  EXPECT_THAT(lines(), testing::SizeIs(NoticeGate::kAtOnce));
}

}  // namespace
}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/link_watch.hpp"

#include <gmock/gmock.h>

#include <cerrno>
#include <deque>
#include <functional>
#include <string>
#include <vector>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A link whose state the test sets.
class ToldLink final : public Link {
 public:
  LinkStatistics counts;
  std::deque<std::string> events;
  std::function<void()> meanwhile = [] {};  // another thread's, after the counts have been read

  bool send(const IpEndpoint&, std::span<const std::byte>) noexcept override { return true; }
  std::size_t receive(std::span<Datagram>) noexcept override { return 0; }
  std::error_code join(const GroupAddress&) noexcept override { return {}; }
  void leave(const GroupAddress&) noexcept override {}
  bool wait(nanoseconds) noexcept override { return false; }
  void wake() noexcept override {}
  [[nodiscard]] IpEndpoint local_endpoint() const noexcept override { return {}; }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return 1372; }
  [[nodiscard]] LinkStatistics statistics() const noexcept override {
    const LinkStatistics read = counts;
    meanwhile();
    return read;
  }
  bool take_event(LinkEvent& event) noexcept override {
    if (events.empty()) return false;
    event = {};
    events.front().copy(event.text.data(), event.text.size() - 1);
    events.pop_front();
    return true;
  }
};

class LinkWatchTest : public testing::Test {
 protected:
  /// The notices within this time, at 20 checks a second; `each` runs before each check.
  template <typename Each>
  std::vector<std::string> run(nanoseconds length, Each each) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(50)) {
      each();
      watch_.look(now_, notices_);
    }
    std::vector<std::string> told;
    for (; notices_.front() != nullptr; notices_.pop())
      told.emplace_back(notices_.front()->text.data());
    return told;
  }
  std::vector<std::string> run(nanoseconds length) {
    return run(length, [] {});
  }

  ToldLink link_;
  Counters counters_;
  Counter& unjoined_ = counters_.make("groups_unjoined", "");
  Counter& base_ = counters_.make("base_unjoined", "");
  haptics::SpscRing<Notice> notices_{64};
  LinkWatch watch_{link_, GroupPool::ipv4_default().base(), 1372, counters_};
  nanoseconds now_ = seconds(100);
};

TEST_F(LinkWatchTest, ReportsOnceThatLongerBundlesDoNotFit) {
  LinkWatch watch(link_, GroupPool::ipv4_default().base(), 9216, counters_);
  for (int i = 0; i < 3; ++i) watch.look(now_, notices_);
  ASSERT_NE(notices_.front(), nullptr);
  EXPECT_THAT(notices_.front()->text.data(),
              testing::StartsWith("bundles are limited to 1372 octets"));
  notices_.pop();
  EXPECT_EQ(notices_.front(), nullptr);
}

TEST_F(LinkWatchTest, IsSilentForAHealthyLink) {
  EXPECT_THAT(run(seconds(60), [&] { ++link_.counts.sent; }), IsEmpty());
}

TEST_F(LinkWatchTest, PassesOnTheEventsOfTheLink) {
  link_.events = {"interface e0 is gone", "interface e0 works again"};
  EXPECT_THAT(run(seconds(1)), ElementsAre("interface e0 is gone", "interface e0 works again"));
}

TEST_F(LinkWatchTest, ReportsWhyTheBaseGroupIsNotJoined) {
  link_.counts.last_join_error = EADDRINUSE;
  base_.set(1);
  unjoined_.set(1);
  EXPECT_THAT(run(seconds(20)),
              ElementsAre(AllOf(HasSubstr("DEAF"), HasSubstr("239.192.1.0:3000"),
                                HasSubstr("Address already in use; another program uses"))));
  base_.set(0);
  unjoined_.set(0);
  EXPECT_THAT(run(seconds(5)), ElementsAre(HasSubstr("239.192.1.0:3000 is joined")));
}

TEST_F(LinkWatchTest, ReportsRefusedGroupsOnceWhileTheirNumberVaries) {
  link_.counts.last_join_error = EMFILE;
  unjoined_.set(12);
  EXPECT_THAT(run(seconds(5)), ElementsAre(AllOf(HasSubstr("12 groups cannot be joined"),
                                                 HasSubstr("ulimit -n 4096"))));
  for (int i = 0; i < 20; ++i) {
    unjoined_.set(static_cast<std::uint64_t>(i % 2));
    EXPECT_THAT(run(seconds(1)), IsEmpty()) << i;
  }
  unjoined_.set(0);
  EXPECT_THAT(run(seconds(5)), ElementsAre("all groups are joined"));
}

TEST_F(LinkWatchTest, ReportsTheCauseOfAConcurrentJoinFailure) {
  link_.meanwhile = [this] {
    link_.counts.last_join_error = EADDRINUSE;
    unjoined_.set(1);
    base_.set(1);
  };
  EXPECT_THAT(run(seconds(1)),
              ElementsAre(AllOf(HasSubstr("DEAF"), HasSubstr("Address already in use"))));
}

TEST_F(LinkWatchTest, RecognisesTheBaseGroupDuringConcurrentCounts) {
  link_.counts.last_join_error = EADDRINUSE;
  for (const bool is_base_first : {true, false}) {
    (is_base_first ? base_ : unjoined_).set(1);
    const auto told = run(milliseconds(50));
    base_.set(1);
    unjoined_.set(1);
    auto more = run(seconds(5));
    more.insert(more.begin(), told.begin(), told.end());
    EXPECT_THAT(more, ElementsAre(HasSubstr("DEAF")));
    base_.set(0);
    unjoined_.set(0);
    EXPECT_THAT(run(seconds(5)), ElementsAre(HasSubstr("239.192.1.0:3000 is joined")));
  }
}

TEST_F(LinkWatchTest, ReportsWhetherAllOrSomeSendsFail) {
  link_.counts.last_send_error = EPERM;
  EXPECT_THAT(run(seconds(5), [&] { ++link_.counts.send_errors; }),
              ElementsAre("SENDING fails: Operation not permitted; a firewall refuses it: nft list "
                          "ruleset"));
  EXPECT_THAT(run(seconds(5)), ElementsAre(HasSubstr("works again; the kernel refused 100")));
  link_.counts.last_send_error = EMSGSIZE;
  EXPECT_THAT(run(seconds(1), [&] { ++link_.counts.send_errors, ++link_.counts.sent; }),
              ElementsAre(HasSubstr("sending some datagrams fails: Message too long")));
}

TEST_F(LinkWatchTest, ReportsThatAllSendsFailAfterSomeSucceeded) {
  link_.counts.last_send_error = EPERM;
  link_.counts.sent = 3;  // during the check that finds the first refusal
  EXPECT_THAT(run(seconds(5), [&] { ++link_.counts.send_errors; }),
              ElementsAre(HasSubstr("SENDING fails")));
}

TEST_F(LinkWatchTest, ReportsASingleRefusal) {
  link_.counts.last_send_error = EMSGSIZE;
  link_.counts.send_errors = 1;
  EXPECT_THAT(run(seconds(2), [&] { ++link_.counts.sent; }),
              ElementsAre(HasSubstr("sending some datagrams fails")));
  EXPECT_THAT(run(seconds(3)), ElementsAre(HasSubstr("works again; the kernel refused 1 ")));
}

TEST_F(LinkWatchTest, ReportsStatesHeldBackOnANarrowWire) {
  EXPECT_THAT(run(seconds(2), [&] { ++link_.counts.held_back; }),
              ElementsAre(HasSubstr("is slower than the traffic")));
  EXPECT_THAT(run(seconds(5)), ElementsAre(HasSubstr("40 were not sent")));
}

TEST_F(LinkWatchTest, ReportsKernelDropsAndTheirEnd) {
  link_.counts.kernel_drops = 17;
  EXPECT_THAT(run(seconds(1)), ElementsAre(HasSubstr("rmem_max")));
  EXPECT_THAT(run(seconds(4)), ElementsAre(HasSubstr("17 were lost")));
}

}  // namespace
}  // namespace reckon::peer

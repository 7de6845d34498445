// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice.hpp"

#include <gtest/gtest.h>

#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {
namespace {

aoim::PresenceEvent event_of(aoim::PresenceEventKind kind) {
  aoim::PresenceEvent event;
  event.kind = kind;
  event.announced.simulation = {7, 2};
  return event;
}

TEST(Notice, TellsAnImpostorWithBothAddresses) {
  aoim::PresenceEvent event = event_of(aoim::PresenceEventKind::impostor);
  event.source = source_of(*IpEndpoint::parse("10.77.0.2:4000"));
  event.other = source_of(*IpEndpoint::parse("[fd00::9]:5000"));
  EXPECT_STREQ(notice_of(event).text.data(),
               "[fd00::9]:5000 speaks in the name of peer 7:2, which is at 10.77.0.2:4000: not "
               "believed");
}

TEST(Notice, TellsADisputeWithAnAddressThatIsNotKnown) {
  aoim::PresenceEvent event = event_of(aoim::PresenceEventKind::disputed);
  event.other = source_of(*IpEndpoint::parse("10.77.0.3:4001"));
  EXPECT_STREQ(notice_of(event).text.data(),
               "peer 7:2 at an unknown address is claimed by another at 10.77.0.3:4001, too");
}

TEST(Notice, TellsHowLongThePeerSlept) {
  aoim::PresenceEvent event = event_of(aoim::PresenceEventKind::slept);
  event.slept = std::chrono::milliseconds(5049);
  EXPECT_STREQ(notice_of(event).text.data(), "this peer slept for 5.0 s");
}

}  // namespace
}  // namespace reckon::peer

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A stalled write loop: datagrams that do not fit the ring are recorded by the tap, the rest is
// sent.
#include <gtest/gtest.h>

#include "reckon/peer/network/datagram_balance.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

TEST(FullRing, IsRecordedByTheTap) {
  const peer::SceneFile scene = scene_of(R"(
[[entity]]
peer = 1
marking = "POST"
type = "1.1.225.1"
dead_reckoning = {heartbeat = "0.1 s"}
)");
  peer::ManualClock clock(seconds(1), std::chrono::hours(1));
  peer::SimulatedNetwork network({}, clock);
  peer::DatagramTap tap;
  peer::PeerOptions own;
  own.epoch = 7;
  own.application = 1;
  own.entities = peer::entities_of(scene, 1);
  own.datagram_ring = peer::kMaxDatagram * 2;
  own.tap = &tap;
  peer::Peer peer(scene, own, network.link(0), {});
  peer.start(clock.now());
  for (int pass = 0; pass < 20'000; ++pass) {
    clock.advance(milliseconds(5));
    peer.read_step(clock.now());
    peer.model_step(clock.now(), clock.utc_now());
  }
  peer.write_step();

  peer::DatagramBalance balance(tap);
  balance.look();
  std::uint64_t numbered = 0, overflown = 0;
  for (const peer::FateCounts& row : balance.report(clock.now(), true).fates) {
    numbered += row.counts[static_cast<std::size_t>(peer::DatagramFate::numbered)];
    overflown += row.counts[static_cast<std::size_t>(peer::DatagramFate::write_overflow)];
  }
  EXPECT_EQ(tap.missed(), 0U);
  EXPECT_GT(overflown, 0U);
  EXPECT_EQ(overflown, peer.counters().find("write_overflow")->value());
  EXPECT_EQ(numbered - overflown, network.link(0).statistics().sent);
}

}  // namespace
}  // namespace reckon::test

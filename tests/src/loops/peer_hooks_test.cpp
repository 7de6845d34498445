// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Mechanisms of a program that watch peers, or act on what they receive and send.
#include "reckon/peer/loops/peer_hooks.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "reckon/pdu/bundle.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;
using pdu::PduType;
using std::chrono::nanoseconds;

// A mechanism that acts: it refuses PDUs of one type.
NamedHooks refuse(PduType type, std::string name = "refuse_pdus") {
  PeerHooks hooks;
  hooks.arriving = [type](const ArrivingPdu& arriving) {
    return arriving.pdu.header.pdu_type == type ? Verdict::refuse : Verdict::pass;
  };
  return {std::move(name), hooks};
}

// A mechanism that watches: it sums the octets of each type of PDU.
class OctetsByType {
 public:
  [[nodiscard]] NamedHooks hooks() {
    PeerHooks hooks;
    hooks.received = [this](std::span<const std::byte> datagram) { add(datagram, received_); };
    hooks.sent = [this](std::span<const std::byte> datagram) { add(datagram, sent_); };
    return {"octets_by_type", hooks};
  }
  [[nodiscard]] std::size_t received(PduType type) const { return received_[index(type)]; }
  [[nodiscard]] std::size_t sent(PduType type) const { return sent_[index(type)]; }

 private:
  using Sums = std::array<std::size_t, 256>;
  static std::size_t index(PduType type) { return static_cast<std::uint8_t>(type); }
  static void add(std::span<const std::byte> datagram, Sums& sums) {
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram))
      sums[index(pdu.header.pdu_type)] += pdu.bytes.size();
  }
  Sums received_{}, sent_{};
};

// Peers without devices, 20 ms a step. Each has a truck that drives 5 m/s to the east.
class PeerHooksTest : public testing::Test {
 protected:
  PeerHooksTest() : scene_(*dis_exercise(1, 0.3, 0.145)) {
    scene_.network.interop = false;
    scene_.aoim.cell = 100.0;
    scene_.aoim.radius = 50.0;
    scene_.aoim.pool = 16;
  }
  Peer& start(std::vector<NamedHooks> mechanisms = {}, double east = 0.0) {
    PeerOptions options;
    options.application = static_cast<std::uint16_t>(peers_.size() + 1);
    options.epoch = options.application;
    options.mechanisms = std::move(mechanisms);
    peers_.push_back(std::make_unique<Peer>(scene_, options, network_.link(peers_.size()),
                                            std::span<const PeerDevice>{}));
    east_.push_back(east);
    EntityDescription truck;
    truck.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
    peers_.back()->model().add(1, truck, truth(peers_.size() - 1));
    peers_.back()->start(clock_.now());
    return *peers_.back();
  }
  void run(nanoseconds span) {
    for (const nanoseconds end = clock_.now() + span; clock_.now() < end;) {
      clock_.advance(20ms);
      for (std::size_t i = 0; i < peers_.size(); ++i) {
        if (drives_) peers_[i]->model().move(1, truth(i));
        peers_[i]->read_step(clock_.now());
        peers_[i]->model_step(clock_.now(), clock_.utc_now());
        peers_[i]->write_step();
      }
    }
  }
  EntityTruth truth(std::size_t peer) const {
    EntityTruth truth;
    truth.time = clock_.now();
    truth.velocity.x() = drives_ ? 5.0 : 0.0;
    truth.position = {50.0 + east_[peer] + truth.velocity.x() * pdu::to_seconds(clock_.now() - 1s),
                      50.0, 0.0};
    return truth;
  }
  [[nodiscard]] static bool shows(const Peer& peer, const Peer& other) {
    return peer.model().remote().find(other.own_id()) != nullptr;
  }
  [[nodiscard]] static std::uint64_t count(const Peer& peer, std::string_view counter) {
    const Counter* found = peer.counters().find(counter);
    return found == nullptr ? 0 : found->value();
  }

  SceneFile scene_;
  ManualClock clock_{1s, 1h};
  SimulatedNetwork network_{options(), clock_};
  std::vector<std::unique_ptr<Peer>> peers_;
  std::vector<double> east_;
  bool drives_ = false;

 private:
  static SimulatedNetworkOptions options() {
    SimulatedNetworkOptions options;
    options.links = 4;
    return options;
  }
};

TEST_F(PeerHooksTest, RefuseArrivingPdusOfOneType) {
  Peer& refuses = start({refuse(PduType::entity_state)});
  Peer& plain = start();
  run(3s);
  EXPECT_FALSE(shows(refuses, plain));
  EXPECT_TRUE(shows(plain, refuses));
  EXPECT_GT(count(refuses, "acts_refuse_pdus"), 0u);
}

TEST_F(PeerHooksTest, RefuseRelayedStates) {
  scene_.aoim.leaders = true;
  start();
  Peer& owner = start();
  run(20s);
  Peer& refuses = start({refuse(PduType::entity_state)});
  Peer& plain = start();
  run(4s);
  EXPECT_TRUE(shows(plain, owner));
  EXPECT_FALSE(shows(refuses, owner));
}

TEST_F(PeerHooksTest, FirstRefusalDecidesAndCounts) {
  Peer& peer = start({refuse(PduType::entity_state, "first"), refuse(PduType::fire, "other"),
                      refuse(PduType::entity_state, "last")});
  start();
  run(3s);
  EXPECT_GT(count(peer, "acts_first"), 0u);
  EXPECT_EQ(count(peer, "acts_other"), 0u);
  EXPECT_EQ(count(peer, "acts_last"), 0u);
}

TEST_F(PeerHooksTest, HoldDueUpdates) {
  bool is_open = false;
  PeerHooks hooks;
  hooks.deciding = [&](const DueUpdate&) { return is_open ? Verdict::pass : Verdict::hold; };
  Peer& holds = start({{"holds", hooks}});
  Peer& other = start();
  run(3s);
  EXPECT_FALSE(shows(other, holds));
  // An entity at rest is asked for ten times a second, and the loop sleeps meanwhile.
  EXPECT_LE(count(holds, "acts_holds"), 31u);
  EXPECT_GE(count(holds, "acts_holds"), 20u);
  EXPECT_GT(holds.next_step(), clock_.now());
  is_open = true;
  run(200ms);
  EXPECT_TRUE(shows(other, holds));
}

TEST_F(PeerHooksTest, ChangeTheGroupOfUpdates) {
  PeerHooks hooks;
  hooks.routing = [](RoutedUpdate& update) {
    update.group = aoim::kBaseGroup;
    return Verdict::change;
  };
  Peer& near = start();
  Peer& changes = start({{"to_all", hooks}}, 300.0);
  run(12s);  // two heartbeats
  EXPECT_FALSE(shows(changes, near));
  // It is too far away to be shown, but its updates arrive.
  EXPECT_EQ(count(near, "not_interesting"), count(changes, "updates_out"));
  EXPECT_EQ(count(changes, "not_interesting"), 0u);
  EXPECT_EQ(count(changes, "acts_to_all"), count(changes, "updates_out"));
}

TEST_F(PeerHooksTest, ImpossibleGroupsAreNotSentTo) {
  PeerHooks hooks;
  hooks.routing = [](RoutedUpdate& update) {
    update.group.value = 60'000;
    return Verdict::change;
  };
  Peer& changes = start({{"astray", hooks}});
  Peer& other = start();
  run(3s);
  EXPECT_GT(count(changes, "acts_astray"), 0u);
  EXPECT_FALSE(shows(other, changes));
}

TEST_F(PeerHooksTest, RefuseLeavingDatagrams) {
  OctetsByType octets;
  PeerHooks hooks;
  hooks.leaving = [](const LeavingDatagram& datagram) {
    return datagram.group == aoim::kBaseGroup ? Verdict::pass : Verdict::refuse;
  };
  Peer& quiet = start({{"quiet", hooks}, octets.hooks()});
  Peer& other = start();
  run(3s);
  EXPECT_FALSE(shows(other, quiet));
  EXPECT_GT(octets.sent(PduType::presence), 0u);
  EXPECT_EQ(octets.sent(PduType::entity_state), 0u);
  EXPECT_GT(count(quiet, "acts_quiet"), 0u);
}

TEST_F(PeerHooksTest, SumOctetsByType) {
  OctetsByType octets;
  Peer& peer = start({octets.hooks()});
  start();
  run(12s);
  EXPECT_EQ(octets.sent(PduType::entity_state), count(peer, "own_octets"));
  EXPECT_EQ(octets.received(PduType::entity_state), 144 * count(peer, "updates_in"));
}

TEST_F(PeerHooksTest, MakeNoCounterUnlessTheyAct) {
  OctetsByType octets;
  const Peer& peer = start({octets.hooks()});
  peer.counters().for_each(
      [](const CounterReading& counter) { EXPECT_FALSE(counter.name.starts_with("acts_")); });
}

TEST_F(PeerHooksTest, AllocateNothingInSteadyState) {
  OctetsByType octets;
  PeerHooks hooks;
  hooks.deciding = [](const DueUpdate&) { return Verdict::pass; };
  hooks.routing = [](RoutedUpdate&) { return Verdict::pass; };
  hooks.leaving = [](const LeavingDatagram&) { return Verdict::pass; };
  drives_ = true;
  start({refuse(PduType::fire), octets.hooks(), {"passes", hooks}});
  start();
  run(10s);
  const test::AllocationGuard guard;
  run(5s);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::peer

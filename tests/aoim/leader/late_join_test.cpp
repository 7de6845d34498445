// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A late peer in a cell of many entities receives each state once, only from the leader.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim::late_join_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr Position kPlace{50.0, 50.0, 0.0};
constexpr std::size_t kOwners = 4, kEntities = 250;  // each

struct Sent {
  std::size_t from;
  GroupIndex group;
  std::vector<std::byte> octets;
};

// Peers in one cell on a segment that loses a share of the snapshots to the newcomer.
struct Cell {
  explicit Cell(double loss_ = 0.0) : loss(loss_) {
    for (std::size_t i = 0; i < kOwners; ++i) add();
    run(seconds(3));
    for (std::size_t i = 0; i < kOwners; ++i) {
      for (std::size_t e = 0; e < kEntities; ++e) say(i, e);
    }
    run(seconds(1));
  }
  void add() {
    AreaOfInterestConfig config;
    config.leader.on = true;
    pdu::Presence own;
    own.simulation = {1, static_cast<std::uint16_t>(peers.size() + 1)};
    own.epoch = static_cast<std::uint32_t>(100 + peers.size());
    own.started = static_cast<std::uint32_t>(1000 + peers.size());
    peers.push_back(std::make_unique<AreaOfInterestManager>(config, own));
    peers.back()->set_utc_offset(seconds(1'000'000), true);
    peers.back()->introductions().set_owned(kEntities);
    alive.push_back(true);
    const Focus focus{kPlace, 0.0, 10.0};
    peers.back()->listen(kCellTier, {&focus, 1}, now);
    peers.back()->start(now);
  }
  void say(std::size_t peer, std::size_t entity) {
    pdu::EntityState state;
    state.entity_id = {1, static_cast<std::uint16_t>(peer + 1),
                       static_cast<std::uint16_t>(entity + 1)};
    state.location = {kPlace.x, kPlace.y, 1.0};
    peers[peer]->send(kCellTier, StatePayload{state}, kPlace, now + milliseconds(5));
  }
  void run(nanoseconds length) {
    for (const nanoseconds end = now + length; now < end; now += milliseconds(1)) step();
  }
  void step() {
    std::vector<Sent> wire;
    for (std::size_t i = 0; i < peers.size(); ++i) {
      if (!alive[i]) continue;
      const pdu::EntityId asked{1, static_cast<std::uint16_t>(i + 1), 1};
      // An owner asks for each of its entities; the first one represents all. The newcomer also
      // introduces its own; that is correct and not counted.
      if (i < kOwners)
        introduced += peers[i]->must_send(kCellTier, asked, kPlace,
                                          {now - seconds(1), peers[i]->route(kPlace)}, now);
      peers[i]->step(now, [&](GroupIndex group, std::span<const std::byte> octets) {
        wire.push_back({i, group, {octets.begin(), octets.end()}});
      });
    }
    for (const Sent& sent : wire) {
      if (counting) count(sent);
      for (std::size_t to = 0; to < peers.size(); ++to) {
        if (!alive[to] || (to >= kOwners && unit(random) < loss)) continue;
        peers[to]->receive(sent.group, sent.octets, now);
      }
    }
    if (peers.size() > kOwners) take_relayed();
  }
  void count(const Sent& sent) {
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(sent.octets)) {
      const bool snapshot = bundled.header.pdu_type == pdu::PduType::cell_snapshot;
      if (snapshot) octets_of[sent.from] += sent.octets.size() + 28;  // with UDP and IP
      states_said += bundled.header.pdu_type == pdu::PduType::entity_state ? 1 : 0;
    }
  }
  void take_relayed() {
    for (const RelayedState& state : peers.back()->leading()->take_relayed(now)) {
      pdu::EntityState decoded;
      ASSERT_EQ(pdu::decode(state.octets, decoded), pdu::DecodeError::none);
      told[decoded.entity_id] = state.epoch;
      last_told = now;
    }
  }
  [[nodiscard]] std::size_t leader() const {
    for (std::size_t i = 0; i < peers.size(); ++i) {
      if (alive[i] && peers[i]->leading()->role().leads(cell())) return i;
    }
    return ~std::size_t{0};
  }
  [[nodiscard]] CellId cell() const {
    return peers[0]->cells().cell_of(peers[0]->cells().group(kPlace));
  }

  std::vector<std::unique_ptr<AreaOfInterestManager>> peers;
  std::vector<bool> alive;
  nanoseconds now = seconds(100), last_told{};
  double loss;
  std::mt19937_64 random{11};
  std::uniform_real_distribution<double> unit{0.0, 1.0};
  bool counting = false;
  std::map<std::size_t, std::size_t> octets_of;  ///< snapshots, by sender
  std::size_t states_said = 0, introduced = 0;
  std::map<pdu::EntityId, std::uint32_t> told;
};

TEST(LateJoin, LeaderSendsThousandStatesOnceWithinASecond) {
  Cell cell;
  const std::size_t leader = cell.leader();
  ASSERT_LT(leader, kOwners);
  cell.counting = true;
  cell.introduced = 0;
  const nanoseconds came = cell.now;
  cell.add();
  cell.run(seconds(2));
  EXPECT_EQ(cell.told.size(), kOwners * kEntities);
  for (const auto& [entity, epoch] : cell.told) EXPECT_EQ(epoch, 99U + entity.application);
  ASSERT_EQ(cell.octets_of.size(), 1U) << "one peer tells";
  EXPECT_EQ(cell.octets_of.begin()->first, leader);
  // Only the states, as in the leader's datagrams without envelope.
  const double share = static_cast<double>(cell.octets_of[leader]) / (1000.0 * 144.0);
  const double took = std::chrono::duration<double>(cell.last_told - came).count();
  std::printf("1,000 entities told after %.3f s with %.3f of their octets\n", took, share);
  EXPECT_LE(share, 1.2);
  EXPECT_LT(took, 1.0);
  EXPECT_EQ(cell.states_said, 0U) << "by the owners";
  EXPECT_EQ(cell.introduced, 0U);
}

TEST(LateJoin, TenSimultaneousNewcomersShareOneSnapshot) {
  Cell cell;
  const std::size_t leader = cell.leader();
  cell.counting = true;
  for (int i = 0; i < 10; ++i) cell.add();
  cell.run(seconds(2));
  EXPECT_EQ(cell.told.size(), kOwners * kEntities);
  EXPECT_LE(static_cast<double>(cell.octets_of[leader]), 1.2 * 1000.0 * 144.0);
}

TEST(LateJoin, LostStatesAreSentAgain) {
  Cell cell(0.2);
  cell.add();
  cell.run(milliseconds(1500));
  EXPECT_EQ(cell.told.size(), kOwners * kEntities);
}

TEST(LateJoin, NewLeaderServesNewcomersWithinTwoSeconds) {
  Cell cell;
  const std::size_t leader = cell.leader();
  cell.alive[leader] = false;
  cell.run(seconds(2));
  const std::size_t next = cell.leader();
  ASSERT_LT(next, kOwners);
  EXPECT_NE(next, leader);
  const std::uint32_t epoch = static_cast<std::uint32_t>(100 + next);
  for (std::size_t i = 0; i < kOwners; ++i) {
    if (!cell.alive[i]) continue;
    EXPECT_EQ(cell.peers[i]->leading()->role().leader(cell.cell()), epoch);
  }
  cell.add();
  cell.run(seconds(1));
  EXPECT_GE(cell.told.size(), (kOwners - 1) * kEntities) << "those of the living";
}

TEST(LateJoin, AsksTheOwnersWhereNoLeaderAnswers) {
  Cell cell;
  const std::size_t leader = cell.leader();
  cell.introduced = 0;
  cell.alive[leader] = false;
  cell.add();
  cell.run(milliseconds(900));
  EXPECT_EQ(cell.introduced, 0U);
  cell.run(milliseconds(500));
  EXPECT_GT(cell.introduced, 0U);
}

// The leader leaves during its snapshot; its successor can get the missing states only from the
// owners.
TEST(LateJoin, SuccessorWithoutASnapshotAsksTheOwners) {
  Cell cell;
  const std::size_t leader = cell.leader();
  const Focus elsewhere{{kPlace.x + 5000.0, kPlace.y, kPlace.z}, 0.0, 10.0};
  for (std::size_t i = 0; i < kOwners; ++i)
    if (i != leader) cell.peers[i]->listen(kCellTier, {&elsewhere, 1}, cell.now);
  cell.run(seconds(5));
  cell.introduced = 0;
  cell.add();
  for (int ms = 0; ms < 500 && cell.told.empty(); ++ms) cell.step(), cell.now += milliseconds(1);
  ASSERT_LT(cell.told.size(), kOwners * kEntities);
  cell.peers[leader]->listen(kCellTier, {&elsewhere, 1}, cell.now);
  cell.run(milliseconds(300));
  EXPECT_TRUE(cell.peers.back()->leading()->role().leads(cell.cell()));
  EXPECT_GT(cell.introduced, 0U);
}

}  // namespace
}  // namespace reckon::aoim::late_join_test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Leaders relay bodies of the scene with their owner, and only states from that owner.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/tests/aoim/support/samples.hpp"

namespace reckon::aoim {
namespace {

using test::Collector;
using test::Datagram;
using test::milliseconds;
using test::nanoseconds;
using test::seconds;

constexpr Position kHome{50.0, 50.0, 0.0};
constexpr pdu::EntityId kBody{kSceneId.site, kSceneId.application, 1};
constexpr std::uint32_t kOwner = 101, kThief = 102;

// A leader, an owner and a thief in one cell; the fourth peer joins it late.
class RelayedBodies : public testing::Test {
 protected:
  RelayedBodies() {
    owners_.set(0, {kOwner, 0});
    for (int i = 0; i < 3; ++i) add();
    run(seconds(3));
  }
  void add() {
    AreaOfInterestConfig config;
    config.leader.on = true;
    config.body_owners = &owners_;
    pdu::Presence own;
    own.simulation = {1, static_cast<std::uint16_t>(peers_.size() + 1)};
    own.epoch = static_cast<std::uint32_t>(100 + peers_.size());
    own.started = static_cast<std::uint32_t>(1000 + peers_.size());
    peers_.push_back(std::make_unique<AreaOfInterestManager>(config, own));
    peers_.back()->set_utc_offset(seconds(1'000'000), true);
    const Focus focus{kHome, 0.0, 10.0};
    peers_.back()->listen(kCellTier, {&focus, 1}, now_);
    peers_.back()->start(now_);
  }
  // The first body at height z [m].
  void say(std::uint32_t epoch, std::uint64_t version, double z) {
    pdu::EntityState state;
    state.entity_id = kBody;
    state.location = {kHome.x, kHome.y, z};
    pdu::OwnershipRecord ownership;
    ownership.owner = epoch;
    ownership.version = version;
    std::array<std::byte, pdu::kOwnershipRecordLength> records;
    static_cast<void>(pdu::store_record(ownership, records));
    peers_[epoch - 100]->send(kCellTier, StatePayload{state, records}, kHome, now_);
    run(milliseconds(10));
  }
  void run(nanoseconds length) {
    for (const nanoseconds end = now_ + length; now_ < end; now_ += milliseconds(1)) {
      std::vector<Collector> wire(peers_.size());
      for (std::size_t i = 0; i < peers_.size(); ++i) peers_[i]->step(now_, wire[i]);
      for (std::size_t from = 0; from < wire.size(); ++from) {
        for (const Datagram& sent : wire[from].datagrams) {
          for (std::size_t to = 0; to < peers_.size(); ++to)
            if (to != from) peers_[to]->receive(sent.group, sent.octets, now_);
        }
      }
      if (peers_.size() < 4) continue;
      for (RelayedState& state : peers_[3]->leading()->take_relayed(now_))
        relayed_.push_back(std::move(state));
    }
  }

  BodyOwners owners_;
  std::vector<std::unique_ptr<AreaOfInterestManager>> peers_;
  std::vector<RelayedState> relayed_;  // to the fourth peer
  nanoseconds now_ = seconds(1);
};

TEST_F(RelayedBodies, ComeWithTheRecordOfTheirOwner) {
  say(kOwner, 6, 1.0);
  say(kOwner, 7, 2.0);
  say(kThief, 9, 3.0);
  ASSERT_TRUE(peers_[0]->leading()->role().leads(
      peers_[0]->cells().cell_of(peers_[0]->subscriptions().cells().joined().front())));
  add();
  run(seconds(3));
  ASSERT_EQ(relayed_.size(), 1U);
  EXPECT_EQ(relayed_[0].epoch, kOwner);
  ASSERT_TRUE(relayed_[0].ownership.has_value());
  EXPECT_EQ(relayed_[0].ownership->owner, kOwner);
  EXPECT_EQ(relayed_[0].ownership->version, 7U);
  pdu::EntityState state;
  ASSERT_EQ(pdu::decode(relayed_[0].octets, state), pdu::DecodeError::none);
  EXPECT_EQ(state.location.z, 2.0);
}

TEST_F(RelayedBodies, ForceModelAndOwnerAreBothKept) {
  StateStore store;
  pdu::EntityState state;
  state.entity_id = kBody;
  store.note({1}, kOwner, state, test::encoded(state), now_);
  std::array<std::byte, pdu::kHapticRecordLength> model;
  std::array<std::byte, pdu::kOwnershipRecordLength> owner;
  static_cast<void>(pdu::store_record(pdu::HapticRecord{}, model));
  static_cast<void>(pdu::store_record(pdu::OwnershipRecord{}, owner));
  for (int i = 0; i < 2; ++i) {
    store.note_records(kOwner, kBody, owner);
    store.note_records(kOwner, kBody, model);
  }
  EXPECT_EQ(store.find(kBody)->records.size(), model.size() + owner.size());
  store.note({1}, kThief, state, test::encoded(state), now_);
  EXPECT_TRUE(store.find(kBody)->records.empty()) << "of another epoch";
}

}  // namespace
}  // namespace reckon::aoim

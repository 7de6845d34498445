// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rows of the scene's bodies: only the owner changes them, and they pass from owner to owner.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/shared_bodies.hpp"
#include "reckon/tests/src/support/incoming_half.hpp"

namespace reckon::peer::body_rows_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr std::uint32_t kOwner = 11, kNext = 12, kThief = 13;

// The incoming half of a peer with three other peers and a scene with two bodies; times in seconds.
class BodyRows : public testing::Test {
 protected:
  explicit BodyRows(const std::string& sections = "")
      : half_("[aoim]\nradius = \"1 km\"\ncell = \"1 km\"\n" + sections,
              [this](const SceneFile& scene) -> RemoteSettings {
                RemoteSettings settings = remote_settings(scene);
                settings.record_changes = true;
                if (!scene.network.interop) settings.body_owners = &owners_;
                return settings;
              }) {
    for (const std::uint32_t epoch : {kOwner, kNext, kThief}) join(epoch);
    own(kOwner);
  }

  static aoim::SourceAddress address_of(std::uint32_t epoch) {
    return {{static_cast<std::uint8_t>(epoch)}, 3000};
  }
  // A peer announces itself, or that it leaves.
  void join(std::uint32_t epoch, bool leaves = false) {
    pdu::Presence own = aoim::announcement(
        presence(half_.scene, half_.frame, half_.pool,
                 {{1, static_cast<std::uint16_t>(epoch)}, "peer", epoch, 0, false}),
        aoim_config(half_.scene));
    if (leaves) own.flags |= pdu::kPresenceLeaving;
    std::array<std::byte, pdu::kFixedSize<pdu::Presence>> octets;
    const std::size_t size = pdu::encode(own, octets);
    static_cast<void>(half_.aoim.receive(aoim::kBaseGroup, std::span(octets).first(size),
                                         nanoseconds(0), address_of(epoch)));
    static_cast<void>(half_.aoim.take_events());
  }
  void leave(std::uint32_t epoch, double time) {
    join(epoch, true);
    half_.remote.drop_peer({1, static_cast<std::uint16_t>(epoch)}, Gone::left,
                           pdu::from_seconds(time));
  }
  void own(std::uint32_t epoch, std::uint64_t version = 0) {
    for (const std::size_t body : {0, 1}) owners_.set(body, {epoch, version});
  }
  // The first body at x [m], moving with `speed` along x, from `sender`, which names `owner`.
  Inbound state(double x, double speed, double time) {
    deadreckon::KinematicState motion;
    motion.algorithm = pdu::DeadReckoningAlgorithm::fpw;
    motion.position = {x, 0, 0};
    motion.velocity = {speed, 0, 0};
    Inbound update;
    update.state.entity_type = body_type(0);
    half_.put_state(update, body_id(0), motion, pdu::from_seconds(time));
    return update;
  }
  void hear(Inbound update, double time, std::uint32_t sender, std::uint32_t owner,
            std::uint64_t version) {
    update.ownership.emplace();
    update.ownership->owner = owner;
    update.ownership->version = version;
    half_.take(update, pdu::from_seconds(time), sender, address_of(sender));
  }
  void hear(double x, double time, std::uint32_t sender, std::uint64_t version = 1,
            double speed = 0.0) {
    hear(state(x, speed, time), time, sender, sender, version);
  }
  [[nodiscard]] const RemoteEntity* row() { return half_.remote.find(body_id(0)); }
  [[nodiscard]] double shown_x(double time) {
    return row()->shown(pdu::from_seconds(time)).position.x();
  }
  [[nodiscard]] std::uint64_t count(std::string_view name) const { return half_.count(name); }

  aoim::BodyOwners owners_;
  test::IncomingHalf half_;
};

TEST_F(BodyRows, StateWithoutRecordIsNotShown) {
  half_.take(state(1, 0, 1), pdu::from_seconds(1), kOwner, address_of(kOwner));
  EXPECT_EQ(row(), nullptr);
  EXPECT_EQ(count("bodies_disputed"), 1U);
  EXPECT_EQ(half_.remote.bodies().last_disputed().from, address_of(kOwner));
  hear(1, 1, kOwner);
  ASSERT_NE(row(), nullptr);
  EXPECT_EQ(row()->epoch, kOwner);
  EXPECT_EQ(count("bodies_disputed"), 1U);
}

TEST_F(BodyRows, OnlyTheOwnerChangesABody) {
  hear(1, 1, kOwner, 5);
  hear(2, 1.1, kThief, 5);
  hear(2, 1.2, kThief, 6);
  hear(state(2, 0, 1.3), 1.3, kThief, kOwner, 6);  // names the owner
  hear(state(2, 0, 1.4), 1.4, kOwner, kThief, 6);  // the owner names another
  hear(2, 1.5, 0, 6);                              // plain DIS
  EXPECT_NEAR(row()->state->position.x(), 1.0, 1e-6);
  EXPECT_EQ(row()->epoch, kOwner);
  EXPECT_EQ(count("bodies_disputed"), 3U);
  EXPECT_EQ(count("bodies_early"), 2U) << "the table may name it soon";
  for (int i = 0; i < 20; ++i) hear(2, 2.0 + 0.1 * i, kThief, 6);
  EXPECT_NEAR(row()->state->position.x(), 1.0, 1e-6);
  EXPECT_GT(count("bodies_disputed"), 10U) << "it does not";
}

TEST_F(BodyRows, NobodySendsABodyWithoutKnownOwner) {
  own(0);
  hear(1, 1, kOwner);
  hear(1, 1, 0);
  EXPECT_EQ(row(), nullptr);
}

TEST_F(BodyRows, NumbersWithoutABodyAreRefused) {
  for (const std::size_t body : {2, 255, 256, 65000}) {
    Inbound update = state(1, 0, 1);
    update.entity = update.state.entity_id = body_id(body);
    hear(update, 1, kOwner, kOwner, 1);
    EXPECT_EQ(half_.remote.find(body_id(body)), nullptr) << body;
  }
}

TEST_F(BodyRows, OlderVersionIsRefused) {
  hear(1, 1, kOwner, 5);
  hear(2, 1.1, kOwner, 4);
  EXPECT_NEAR(row()->state->position.x(), 1.0, 1e-6);
  EXPECT_EQ(count("bodies_stale"), 1U);
  own(kOwner, 7);
  hear(2, 1.2, kOwner, 6);
  EXPECT_NEAR(row()->state->position.x(), 1.0, 1e-6);
  EXPECT_EQ(count("bodies_stale"), 2U);
  hear(2, 1.3, kOwner, 7);
  EXPECT_NEAR(row()->state->position.x(), 2.0, 1e-6);
}

TEST_F(BodyRows, NextOwnerTakesTheRowWithoutAJump) {
  hear(1, 1, kOwner, 1, 0.5);
  hear(1.05, 1.1, kOwner, 1, 0.5);
  static_cast<void>(half_.remote.take_changes());
  const double before = shown_x(1.2);
  own(kNext);
  hear(1.13, 1.2, kNext, 2, 0.5);
  ASSERT_NE(row(), nullptr);
  EXPECT_NEAR(shown_x(1.2), before, 1e-3);
  EXPECT_EQ(row()->epoch, kNext);
  EXPECT_EQ(half_.remote.bodies().recorded(body_id(0)).version, 2U);
  EXPECT_EQ(row()->updates, 3U);
  EXPECT_EQ(half_.remote.owner(*row()), address_of(kNext));
  EXPECT_EQ(half_.remote.bodies().owner_of(*row()), (aoim::PeerId{1, kNext}));
  for (const EntityChange& change : half_.remote.take_changes())
    EXPECT_EQ(change.change, Change::updated);
  EXPECT_NEAR(shown_x(3.2), 1.13 + 0.5 * 2, 1e-3) << "it has converged";
}

TEST_F(BodyRows, NextOwnerMayHaveAnotherClock) {
  hear(1, 1, kOwner);
  own(kNext);
  hear(state(2, 0, 1 - 900), 1.1, kNext, kNext, 2);  // a quarter of an hour behind
  EXPECT_NEAR(row()->state->position.x(), 2.0, 1e-6);
  EXPECT_EQ(count("stale_in"), 0U);
}

TEST_F(BodyRows, FormerOwnerIsRefusedAfterTheTakeOver) {
  hear(1, 1, kOwner);
  own(kNext);
  hear(2, 1.1, kNext, 2);
  hear(1, 1.2, kOwner, 1);
  EXPECT_NEAR(row()->state->position.x(), 2.0, 1e-6);
  own(kOwner);  // a table that lags behind the row
  hear(1, 1.3, kOwner, 1);
  hear(1, 1.3, kOwner, 2);
  EXPECT_NEAR(row()->state->position.x(), 2.0, 1e-6);
  EXPECT_EQ(row()->epoch, kNext);
  EXPECT_EQ(count("bodies_stale"), 2U);
}

TEST_F(BodyRows, BodyStaysWhenItsOwnerLeaves) {
  hear(1, 1, kOwner, 3, 0.5);
  leave(kOwner, 1.2);
  ASSERT_NE(row(), nullptr);
  EXPECT_NEAR(shown_x(1.2), 1.1, 1e-6);
  const double rest = shown_x(1.8);
  EXPECT_LT(rest, 1.1 + 0.5 * 0.5);
  half_.remote.expire(std::chrono::hours(5));
  ASSERT_NE(row(), nullptr);
  EXPECT_NEAR(shown_x(5 * 3600), rest, 1e-9);
  EXPECT_TRUE(row()->shown(pdu::from_seconds(1.8)).velocity.isZero());
  own(kNext);
  hear(rest, 20, kNext, 1);  // it begins anew
  EXPECT_EQ(row()->epoch, kNext);
  EXPECT_EQ(row()->doubted_at, RemoteEntity::kTrusted);
}

TEST_F(BodyRows, BodyIsNeverDeactivated) {
  hear(1, 1, kOwner);
  Inbound update = state(1, 0, 1.5);
  update.state.appearance = pdu::kAppearanceDeactivated;
  hear(update, 1.5, kOwner, kOwner, 1);
  EXPECT_NE(row(), nullptr);
}

TEST_F(BodyRows, BodyOutsideReturnsAfterItsOwnerHasLeft) {
  hear(1200, 1, kOwner, 4);
  EXPECT_EQ(row(), nullptr);
  leave(kOwner, 2);
  own(0);
  const nanoseconds late = pdu::from_seconds(400);
  half_.remote.look_outside(late);
  half_.stand_at({400, 0, 0}, late);
  half_.remote.look_outside(late + std::chrono::seconds(2));
  ASSERT_NE(row(), nullptr);
  EXPECT_EQ(half_.remote.bodies().recorded(body_id(0)).version, 4U);
  EXPECT_NE(row()->doubted_at, RemoteEntity::kTrusted);
}

TEST_F(BodyRows, ForceModelOfABodyIsIgnored) {
  Inbound update = state(1, 0, 1);
  update.has_model = true;
  update.model.kind = pdu::ForceModelKind::sphere;
  update.model.k1 = 500;
  update.model.radius = 0.05F;
  update.model.validity_ms = 60'000;
  hear(update, 1, kOwner, kOwner, 1);
  ASSERT_NE(row(), nullptr);
  EXPECT_FALSE(row()->haptic);
}

TEST_F(BodyRows, OnlyTheOwnerSpeaksForABody) {
  const auto right = [&](std::uint32_t sender) {
    const pdu::EntityId id = body_id(1);
    Arrival arrival;
    arrival.epoch = sender;
    arrival.from = address_of(sender);
    return half_.remote.sender_right(std::span(&id, 1), arrival);
  };
  EXPECT_EQ(right(kOwner), SenderRight::owner);
  EXPECT_EQ(right(kThief), SenderRight::refused);
  EXPECT_EQ(right(0), SenderRight::refused);
}

class PlainBodyRows : public BodyRows {
 protected:
  PlainBodyRows() : BodyRows("[network]\ninterop = true\n") {}
};

TEST_F(PlainBodyRows, SceneAddressIsLikeAnyOther) {
  half_.take(state(1, 0, 1), pdu::from_seconds(1), 0, address_of(kOwner));
  ASSERT_NE(row(), nullptr);
  EXPECT_EQ(count("bodies_disputed"), 0U);
}

}  // namespace
}  // namespace reckon::peer::body_rows_test

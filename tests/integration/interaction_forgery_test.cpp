// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Fires and other PDUs besides states, sent in the name of another: no program receives them, and
// the user is informed. Received ones come with their sender.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "reckon/pdu/emission/designator.hpp"
#include "reckon/pdu/entity/collision.hpp"
#include "reckon/pdu/entity/entity_state_update.hpp"
#include "reckon/pdu/logistics/resupply_offer.hpp"
#include "reckon/pdu/management/comment.hpp"
#include "reckon/pdu/radio/signal.hpp"
#include "reckon/pdu/type_names.hpp"
#include "reckon/pdu/warfare/detonation.hpp"
#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/integration/federates.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using peer::InteractionSender;

/// The first federate receives, the second has a truck; the last link is a stranger's.
class ForgedInteractions : public ::testing::TestWithParam<bool> {
 protected:
  static constexpr std::size_t kStranger = 3;

  ForgedInteractions() : scene_(*peer::dis_exercise(1, 0.82, 0.145)), world_(4, {}) {
    scene_.network.interop = GetParam();
    scene_.hash = peer::scene_hash(scene_);
    hear<pdu::Fire>(world_.join(scene_));
    peer::EntityDescription truck;
    truck.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
    peer::Federate& owner = world_.join(scene_);
    const auto handle = owner.register_object(truck, {});
    pass(1s);
    truck_ = owner.id_of(handle);
    EXPECT_EQ(world_[0].size(), 1U);
  }

  void pass(std::chrono::nanoseconds span) {
    world_.run(
        span, 10ms, [] {}, [] {});
  }
  template <pdu::Pdu T>
  void hear(peer::Federate& federate) {
    federate.subscribe<T>(
        [this](const T&, const InteractionSender& sender) { heard_.push_back(sender); });
  }
  template <pdu::Pdu T>
  void say_as_stranger(T message) {
    message.header.exercise_id = 1;
    std::vector<std::byte> octets(pdu::wire_size(message));
    ASSERT_EQ(pdu::encode(message, octets), octets.size());
    ASSERT_TRUE(world_.link(kStranger).send(scene_.network.group, octets));
    pass(50ms);
  }
  template <pdu::Pdu T>
  void expect_refused(const T& forged) {
    hear<T>(world_[0]);
    const std::uint64_t before = refused();
    for (int i = 0; i < 10; ++i) say_as_stranger(forged);
    EXPECT_TRUE(heard_.empty()) << pdu::name(T::kPduType);
    EXPECT_EQ(refused() - before, 10U) << pdu::name(T::kPduType);
  }
  [[nodiscard]] std::uint64_t refused() { return world_.count(0, "interactions_refused"); }
  [[nodiscard]] std::string endpoint(std::size_t link) {
    return world_.link(link).local_endpoint().text();
  }
  [[nodiscard]] bool is_told(const std::string& words) {
    auto& ring = world_[0].peer().notices();
    bool found = false;
    for (const peer::Notice* notice = ring.front(); notice != nullptr; notice = ring.front()) {
      found = found || std::string(notice->text.data()).find(words) != std::string::npos;
      ring.pop();
    }
    return found;
  }

  peer::SceneFile scene_;
  Federates world_;
  pdu::EntityId truck_;
  std::vector<InteractionSender> heard_;
};

TEST_P(ForgedInteractions, AreRefusedAndReported) {
  pdu::Fire fire;
  fire.firing_entity_id = truck_;
  expect_refused(fire);
  EXPECT_TRUE(is_told("refused entities under this number from " + endpoint(kStranger)));
  pdu::Detonation detonation;
  detonation.source_entity_id = truck_;
  expect_refused(detonation);
  pdu::Collision collision;
  collision.issuing_entity_id = truck_;
  expect_refused(collision);
  pdu::EntityStateUpdate update;
  update.entity_id = truck_;
  expect_refused(update);
  pdu::Designator spot;
  spot.designating_entity_id = truck_;
  expect_refused(spot);
  pdu::Signal signal;
  signal.reference_id = truck_;
  expect_refused(signal);
  pdu::Comment comment;
  comment.originating_entity_id = truck_;
  expect_refused(comment);
  pdu::ResupplyOffer offer;
  offer.supplying_entity_id = truck_;
  expect_refused(offer);
}

TEST_P(ForgedInteractions, InTheReceiversNameAreRefusedAndReported) {
  pdu::Fire fire;
  fire.firing_entity_id = {1, 1, 1};
  expect_refused(fire);
  EXPECT_TRUE(is_told("refused: " + endpoint(kStranger) + " sends entities of this peer, 1:1;"));
}

TEST_P(ForgedInteractions, AreDistinguishedFromTheOwners) {
  world_[1].publish<pdu::Fire>();
  pdu::Fire fire;
  fire.firing_entity_id = truck_;
  world_[1].send(fire);
  pass(50ms);
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_TRUE(heard_[0].owns);
  EXPECT_EQ(peer::AddressText(heard_[0].address).view(), endpoint(1));
  const auto named = GetParam() ? std::nullopt : std::optional(truck_.simulation());
  EXPECT_EQ(heard_[0].peer, named);
  EXPECT_EQ(refused(), 0U);
}

TEST_P(ForgedInteractions, UnderAnUnknownIdHaveNoOwner) {
  pdu::Fire fire;
  fire.firing_entity_id = {9, 9, 9};
  say_as_stranger(fire);
  ASSERT_EQ(heard_.size(), 1U);
  EXPECT_FALSE(heard_[0].owns);
  EXPECT_EQ(heard_[0].peer, std::nullopt);
  EXPECT_EQ(peer::AddressText(heard_[0].address).view(), endpoint(kStranger));
}

TEST_P(ForgedInteractions, AddressedToTheNamedEntityAreReceived) {
  hear<pdu::ResupplyOffer>(world_[0]);
  pdu::ResupplyOffer offer;
  offer.receiving_entity_id = truck_;
  offer.supplying_entity_id = {9, 9, 9};
  say_as_stranger(offer);
  EXPECT_EQ(heard_.size(), 1U);
  EXPECT_EQ(refused(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ForgedInteractions, ::testing::Bool(),
                         [](const auto& scene) { return scene.param ? "Interop" : "Peers"; });

}  // namespace
}  // namespace reckon::test

// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The forces of entities whose owner was silent too long.
#include <gtest/gtest.h>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/tests/src/support/incoming_half.hpp"

namespace reckon::peer {
namespace {

constexpr pdu::EntityId kDoubted{7, 8, 9};
constexpr pdu::EntityType kHandType{pdu::EntityKind::life_form, pdu::EntityDomain::land};
constexpr pdu::EntityType kPegType{pdu::EntityKind::cultural_feature, pdu::EntityDomain::land};

// The incoming half of a peer that receives one entity; times in seconds from the start.
class DoubtedHalf {
 public:
  void hear(const pdu::EntityType& type, double time) {
    Inbound update;
    update.has_model = true;
    update.model.kind = pdu::ForceModelKind::sphere;
    update.state.entity_type = type;
    half_.put_state(update, kDoubted, {}, pdu::from_seconds(time), {});
    half_.take(update, pdu::from_seconds(time));
  }
  void doubt(double time) { half_.remote.doubt(kDoubted, pdu::from_seconds(time)); }
  void believe(double time) {
    const std::chrono::nanoseconds now = pdu::from_seconds(time);
    half_.remote.believe_peer(0, now, now);
  }
  // Seconds until which its force is full; then it fades.
  [[nodiscard]] double felt_until() const {
    return pdu::to_seconds(half_.remote.find(kDoubted)->felt_until);
  }

 private:
  test::IncomingHalf half_{
      "", [](const SceneFile& scene) -> RemoteSettings {
        return {scene.hand.radius, scene.convergence, scene.dead_reckoning.acceleration};
      }};
};

const double kForEver = pdu::to_seconds(RemoteEntity::kTrusted);

// A life proof of the owner does not contain the entity's position.
TEST(DoubtedEntity, IsFeltOnlyAfterItsNextState) {
  DoubtedHalf half;
  half.hear(kPegType, 1);
  half.doubt(3.5);
  EXPECT_EQ(half.felt_until(), 3.5) << "it fades";
  half.believe(3.51);
  EXPECT_EQ(half.felt_until(), 1.0) << "nothing is left to fade";
  half.hear(kPegType, 1);
  half.doubt(6);
  half.believe(6.5);
  EXPECT_EQ(half.felt_until(), 1.0) << "an old state, doubted twice";
  half.hear(kPegType, 7);
  EXPECT_EQ(half.felt_until(), kForEver);
}

TEST(DoubtedEntity, HandsNeedANewStatePegsDoNot) {
  DoubtedHalf half;
  half.hear(kPegType, 1);
  half.believe(2);
  EXPECT_EQ(half.felt_until(), kForEver);
  half.hear(kHandType, 3);
  half.believe(4);
  EXPECT_EQ(half.felt_until(), 3.0);
}

}  // namespace
}  // namespace reckon::peer

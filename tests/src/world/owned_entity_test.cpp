// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Data of an entity that an update omits.
#include "reckon/peer/world/owned_entity.hpp"

#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

constexpr aoim::Body kBodies[] = {aoim::Body::rigid, aoim::Body::approximate, aoim::Body::full};
constexpr std::uint32_t kTurret = 128;  // SISO UID 59

const deadreckon::LocalFrame& frame() {
  static const deadreckon::LocalFrame frame(0.82, 0.145, 430.0);
  return frame;
}

deadreckon::PartState turned(double azimuth) {
  deadreckon::PartState parts;
  parts.set({kTurret, 0, deadreckon::PartMetric::azimuth, 0, azimuth, 0.0});
  return parts;
}

std::unique_ptr<OwnedEntity> entity(bool is_felt, bool has_parts) {
  EntityDescription crane;
  crane.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 7, 1, 0, 0};
  if (is_felt) {
    crane.model.emplace();
    crane.model->kind = pdu::ForceModelKind::sphere;
    crane.model->k1 = 500.0;
    crane.model->radius = 0.05;
  }
  auto made = std::make_unique<OwnedEntity>(frame(), crane, pdu::EntityId{1, 1, 1}, 1, 1.0);
  if (has_parts) made->set_parts(turned(0.5));
  EntityTruth truth;
  truth.time = 1s;
  EXPECT_TRUE(made->move(truth));
  return made;
}

EntityUpdate built(OwnedEntity& entity, aoim::Body body) {
  EntityUpdate update;
  EXPECT_TRUE(entity.build(1s, 1h, deadreckon::SendReason::event, {}, update, body));
  return update;
}

// Compares the rule with the updates of build().
TEST(OwnedEntity, IsThinnedByBodiesThatOmitItsData) {
  for (const bool is_felt : {false, true}) {
    for (const bool has_parts : {false, true}) {
      const auto made = entity(is_felt, has_parts);
      const EntityUpdate whole = built(*made, aoim::Body::full);
      const std::size_t parts = whole.state.variable_parameters.size();
      EXPECT_EQ(whole.has_model, is_felt);
      EXPECT_EQ(parts > 0, has_parts);
      for (const aoim::Body body : kBodies) {
        const EntityUpdate update = built(*made, body);
        const bool lacks =
            update.has_model != whole.has_model || update.state.variable_parameters.size() != parts;
        EXPECT_EQ(made->is_thinned(body), lacks)
            << "felt " << is_felt << ", parts " << has_parts << ", body " << static_cast<int>(body);
      }
    }
  }
}

TEST(OwnedEntity, IsNotThinnedWithoutOmittedData) {
  for (const aoim::Body body : kBodies) EXPECT_FALSE(entity(false, false)->is_thinned(body));
  const auto crane = entity(false, true), hand = entity(true, false);
  EXPECT_TRUE(crane->is_thinned(aoim::Body::rigid));
  EXPECT_FALSE(crane->is_thinned(aoim::Body::approximate)) << "its parts are all that it has more";
  EXPECT_TRUE(hand->is_thinned(aoim::Body::approximate)) << "nor is it felt from there";
  EXPECT_FALSE(hand->is_thinned(aoim::Body::full));
}

// Channels: an approximate update contains the parts of a crane, which is all its data.
TEST(OwnedEntity, CraneIsCompleteWithoutForceModel) {
  for (const aoim::Body body : kBodies) {
    const auto crane = entity(false, true);
    constexpr aoim::Channel kRow{100.0, aoim::Body::approximate, 10.0, 1.0, 4.0, false, 1.0};
    crane->set_tiers(0, std::array{kRow, kRow});
    EntityUpdate update;
    ASSERT_TRUE(crane->build(1s, 1h, deadreckon::SendReason::event, {}, update, body));
    crane->audiences()->event(1);
    ASSERT_TRUE(
        crane->build(2s, 1h, deadreckon::SendReason::position, {}, update, aoim::Body::full, 0));
    ASSERT_TRUE(crane->audiences()->is_behind(1));
    ASSERT_TRUE(crane->build(3s, 1h, deadreckon::SendReason::position, {}, update, body));
    EXPECT_EQ(crane->audiences()->is_behind(1), crane->is_thinned(body)) << static_cast<int>(body);
  }
}

// It holds from the first part on. Peers that received parts must also receive their removal.
TEST(OwnedEntity, StaysThinnedAfterItsFirstPart) {
  const auto made = entity(false, false);
  EXPECT_FALSE(made->is_thinned(aoim::Body::rigid));
  made->set_parts(turned(0.5));
  EXPECT_TRUE(made->is_thinned(aoim::Body::rigid));
  made->set_parts({});
  EXPECT_TRUE(made->is_thinned(aoim::Body::rigid));
}

TEST(OwnedEntities, BodyKeepsItsIdInARename) {
  OwnedEntities owned(frame(), {{1, 2}, 1, 1.0, pdu::CompressedForm::compact, 0, {}});
  pdu::OwnershipRecord ownership;
  ownership.owner = 77;
  ownership.version = 3;
  ASSERT_TRUE(owned.add_body(1, {}, body_id(4), ownership));
  ASSERT_TRUE(owned.add(2, {}));
  owned.rename({1, 9});
  EXPECT_EQ(owned.find(1)->id(), (pdu::EntityId{65534, 1, 5}));
  EXPECT_EQ(owned.find(2)->id(), (pdu::EntityId{1, 9, 2}));
  EXPECT_EQ(owned.first_id(), owned.find(2)->id()) << "a body is not the first entity of a peer";
  EXPECT_EQ(owned.find(1)->compressor(), nullptr);
  EXPECT_NE(owned.find(2)->compressor(), nullptr);
}

TEST(OwnedEntity, EachUpdateOfABodyNamesItsOwner) {
  for (const aoim::Body body : kBodies) {
    const auto made = entity(true, false);
    pdu::OwnershipRecord ownership;
    ownership.owner = 77;
    ownership.version = 3;
    made->own_by(ownership);
    std::array<std::byte, kMaxEntityRecords> records;
    const std::size_t size = store_records(built(*made, body), records);
    ASSERT_GE(size, pdu::kOwnershipRecordLength);
    pdu::OwnershipRecord read;
    ASSERT_TRUE(
        pdu::load_record(std::span(records).subspan(size - pdu::kOwnershipRecordLength), read));
    EXPECT_EQ(read.type, pdu::kOwnershipRecordType);
    EXPECT_EQ(read.owner, 77U);
    EXPECT_EQ(read.version, 3U);
  }
}

}  // namespace
}  // namespace reckon::peer

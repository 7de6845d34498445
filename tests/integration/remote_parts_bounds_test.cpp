// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Remote articulated parts: hostile, too many, none, and recorded ones.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

#include "reckon/tests/integration/parts_receiver.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::peer::test {
namespace {

using deadreckon::PartState;

// --- bounds

TEST(RemoteParts, OfEntitiesWithoutAnyTakeNoPlace) {
  PartsReceiver receiver;
  for (std::uint16_t id = 1; id <= 1000; ++id) receiver.hear({}, 1, 1, id);
  EXPECT_EQ(receiver.remote().rows().size(), 1000U);
  EXPECT_EQ(receiver.remote().with_parts(), 0U);
  EXPECT_EQ(receiver.count("parts_full"), 0U);
}

TEST(RemoteParts, BeyondThePoolAreCountedOnly) {
  PartsReceiver receiver;
  constexpr auto kAll = static_cast<std::uint16_t>(RemoteParts::kEntities + 3);
  for (std::uint16_t id = 1; id <= kAll; ++id) receiver.hear(turret(0.5, 0), 1, 1, id);
  EXPECT_EQ(receiver.remote().rows().size(), kAll);
  EXPECT_EQ(receiver.remote().with_parts(), RemoteParts::kEntities);
  EXPECT_EQ(receiver.count("parts_full"), 3U);
  EXPECT_EQ(receiver.count("updates_in"), kAll);
  EXPECT_TRUE(receiver.parts(1, {7, 8, kAll}).empty());

  receiver.hear({}, 2, 2, 5);
  receiver.hear(turret(0.75, 0), 2, 2, kAll);
  ASSERT_EQ(receiver.parts(2, {7, 8, kAll}).size(), 1U);
  EXPECT_EQ(receiver.parts(2, {7, 8, kAll})[0].value, 0.75);
  EXPECT_EQ(receiver.count("parts_full"), 3U);
}

TEST(RemoteParts, InvalidOnesAreOmittedAndCounted) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  PartsReceiver receiver, plain;
  receiver.hear(octets_of({{kTurret, 11, 1.0F},  // good
                           {kTurret, 12, kInfinity},
                           {kGun, 13, kNan},
                           {kGun, 14, 1.0F},  // a rate without an angle
                           {96, 0, 1.0F},     // metrics that are not listed
                           {96, 17, 1.0F}}),
                1, 1);
  EXPECT_EQ(receiver.count("parts_refused"), 5U);
  ASSERT_EQ(receiver.parts(1).size(), 1U);
  EXPECT_EQ(receiver.part(kTurret, 2).value, 1);

  std::vector<Record> many;
  for (std::uint32_t i = 0; i < 255; ++i) many.push_back({i, 11, 0.5F});
  receiver.hear(octets_of(many), 2, 2);
  EXPECT_EQ(receiver.parts(2).size(), PartState::kCapacity);
  EXPECT_EQ(receiver.count("parts_refused"), 5U + 255 - PartState::kCapacity);

  receiver.hear(octets_of({{kTurret, 11, kNan}}), 3, 3);
  EXPECT_TRUE(receiver.parts(3).empty());

  for (const double t : {1.0, 2.0, 3.0}) plain.hear({}, t, t);
  EXPECT_EQ(receiver.count("updates_in"), 3U);
  EXPECT_EQ(receiver.row()->predicted(pdu::from_seconds(3.05)).position,
            plain.row()->predicted(pdu::from_seconds(3.05)).position);
}

TEST(RemoteParts, StayFiniteForRandomOctets) {
  PartsReceiver receiver;
  std::mt19937 random(1);
  std::vector<std::byte> records;
  for (int round = 1; round <= 2000; ++round) {
    records.resize(16 * (random() % 41));
    for (std::byte& octet : records) octet = static_cast<std::byte>(random());
    for (std::size_t i = 0; i < records.size(); i += 16) {
      records[i] = static_cast<std::byte>(random() % 2);
      records[i + 7] = static_cast<std::byte>(random() % 40);
    }
    const double now = 0.05 * round;
    receiver.hear(records, now, now);
    for (const double t : {now, now + 0.02, now + 100}) {
      const ShownParts all = receiver.parts(t);
      ASSERT_LE(all.size(), PartState::kCapacity);
      for (std::size_t i = 0; i < all.size(); ++i)
        ASSERT_TRUE(std::isfinite(all[i].value) && std::isfinite(all[i].rate)) << round;
    }
  }
  EXPECT_EQ(receiver.count("updates_in"), 2000U);
  EXPECT_GT(receiver.count("parts_refused"), 100U);
}

TEST(RemoteParts, AllocateNothing) {
  PartsReceiver receiver;
  const auto one = turret(0.5, 0.1);
  const reckon::test::AllocationGuard guard;
  for (int round = 1; round <= 20; ++round) {
    for (std::uint16_t id = 1; id <= 300; ++id) {
      const bool bare = (round + id) % 3 == 0;
      receiver.hear(bare ? std::span<const std::byte>() : std::span<const std::byte>(one), round,
                    round, id);
    }
    if (round % 5 == 0) receiver.remote().drop_peer({7, 8}, Gone::left, {});
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(receiver.count("updates_in"), 5000U);
}

// --- recorded

std::vector<std::byte> recorded(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::vector<char> chars((std::istreambuf_iterator<char>(in)), {});
  const auto octets = std::as_bytes(std::span(chars));
  return {octets.begin(), octets.end()};
}

// A frame on the ground below a geocentric position, to some km.
deadreckon::LocalFrame below(const pdu::WorldCoordinates& place) {
  constexpr double kFlattening = 1 - 0.00669437999014;
  return {std::atan2(place.z, kFlattening * std::hypot(place.x, place.y)),
          std::atan2(place.y, place.x), 0};
}

// The expected values, read by a script that shares no code with the codec.
struct Recorded {
  const char* file;
  pdu::EntityId id;
  std::size_t parts;
  std::uint32_t part;
  double value, rate;
  bool frozen;
};

TEST(RemoteParts, RecordedEntityStatesOfThreeProductsAreShown) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  const std::array<Recorded, 4> all{{
      {"dis6/EntityStatePdu-vrf-articulated-parameters.raw",
       {1, 3001, 4},
       4,
       kTurret,
       -0.785398006439209,
       -0.26232632994651794,
       false},
      {"dis6/EntityStatePdu-vbs-articulated-parameters.raw",
       {1425, 2850, 1},
       8,
       kTurret,
       -1.5411100387573242,
       0,
       true},
      {"dis6/EntityStatePdu-vbs-articulated-parameters.raw",
       {1425, 2850, 1},
       8,
       kGun,
       0.07811719179153442,
       0,
       true},
      {"dis7/EntityStatePdu-articulated_parts.raw",
       {1, 200, 1},
       2,
       kGun,
       1.2814699411392212,
       0,
       false},
  }};
  for (const Recorded& expected : all) {
    SCOPED_TRACE(expected.file);
    const auto octets =
        recorded(reckon::test::reference_data() / "dis-captures/real-pdus" / expected.file);
    pdu::EntityState state;
    ASSERT_EQ(pdu::decode(std::span<const std::byte>(octets), state), pdu::DecodeError::none);
    PartsReceiver receiver(below(state.location));
    receiver.hear_octets(octets, 100);
    const RemoteEntity* row = receiver.remote().find(expected.id);
    ASSERT_NE(row, nullptr);
    EXPECT_EQ(row->frozen, expected.frozen);
    EXPECT_EQ(receiver.count("parts_refused"), 0U);
    for (const double age : {0.0, 0.5, 3.0}) {
      const ShownParts parts = receiver.parts(pdu::to_seconds(row->state_time) + age, expected.id);
      ASSERT_EQ(parts.size(), expected.parts);
      std::size_t seen = 0;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].part != expected.part) continue;
        ++seen;
        EXPECT_NEAR(parts[i].value, expected.value + age * expected.rate, 1e-6);
        EXPECT_EQ(parts[i].rate, expected.rate);
      }
      EXPECT_EQ(seen, 1U);
    }
  }
}

}  // namespace
}  // namespace reckon::peer::test

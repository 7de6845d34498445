// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include "reckon/deadreckon/motion/articulation.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/tests/deadreckon/support/parts.hpp"

namespace reckon::deadreckon::test {
namespace {

// A record octet by octet, as defined in the standard.
std::vector<std::byte> record(std::uint32_t part, unsigned metric, float value,
                              std::uint16_t attached_to = 0, std::uint8_t change = 0) {
  const std::uint32_t type = part * 32 + metric;
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  std::vector<std::byte> octets = {std::byte{0}, std::byte{change}};
  const auto put = [&](std::uint32_t number, int size) {
    for (int i = size - 1; i >= 0; --i)
      octets.push_back(static_cast<std::byte>((number >> (8 * i)) & 0xFF));
  };
  put(attached_to, 2);
  put(type, 4);
  put(bits, 4);
  put(0, 4);
  return octets;
}

std::vector<std::byte> together(const std::vector<std::vector<std::byte>>& records) {
  std::vector<std::byte> all;
  for (const auto& r : records) all.insert(all.end(), r.begin(), r.end());
  return all;
}

TEST(Articulation, RoundTripsEveryMetricOnTheWire) {
  Random random(1);
  for (int round = 0; round < 1000; ++round) {
    const PartState state = random_state(random);
    std::array<std::byte, 64 * 16> octets;
    const std::size_t size = to_wire(state, octets);
    ASSERT_EQ(size, 32 * state.parameters().size());
    PartState back;
    const PartReading reading = from_wire(std::span(octets).first(size), back);
    ASSERT_EQ(reading.taken, 2 * state.parameters().size());
    ASSERT_EQ(back.parameters().size(), state.parameters().size());
    for (std::size_t i = 0; i < back.parameters().size(); ++i) {
      const PartParameter &a = state.parameters()[i], &b = back.parameters()[i];
      ASSERT_TRUE(same_place(a, b));
      ASSERT_EQ(a.attached_to, b.attached_to);
      ASSERT_EQ(a.change, b.change);
      ASSERT_EQ(b.value, static_cast<double>(static_cast<float>(a.value)));
      ASSERT_EQ(b.rate, static_cast<double>(static_cast<float>(a.rate)));
    }
    EXPECT_EQ(to_wire(state, std::span(octets).first(size - (size > 0 ? 1 : 0))), 0u);
  }
}

TEST(Articulation, WritesTheOctetsOfTheStandard) {
  PartState state = one(parameter(kTurret, PartMetric::azimuth, 0.5, -0.25));
  PartParameter gun = parameter(kGun, PartMetric::elevation, 0.125);
  gun.attached_to = 1;
  ASSERT_TRUE(state.set(gun));
  std::array<std::byte, 64> octets;
  ASSERT_EQ(to_wire(state, octets), 64u);
  const auto expected = together({record(kTurret, 11, 0.5F), record(kTurret, 12, -0.25F),
                                  record(kGun, 13, 0.125F, 1), record(kGun, 14, 0.0F, 1)});
  EXPECT_TRUE(std::equal(octets.begin(), octets.end(), expected.begin(), expected.end()));
}

// From octet 144 on, read by a separate script that shares nothing with the codec.
struct Recorded {
  const char* file;
  std::size_t records, parts, index;
  std::uint32_t part;
  PartMetric metric;
  double value, rate;
  std::uint16_t attached_to;
};

TEST(Articulation, ReadsTheRecordedEntityStatesOfThreeProducts) {
  RECKON_NEED_DATA("dis-captures/real-pdus");
  const std::array<Recorded, 5> all{{
      {"dis6/EntityStatePdu-vrf-articulated-parameters.raw", 8, 4, 0, 128, PartMetric::azimuth,
       -0.785398006439209, -0.26232632994651794, 0},
      {"dis6/EntityStatePdu-vrf-articulated-parameters.raw", 8, 4, 3, 139, PartMetric::elevation, 0,
       0, 2},
      // This product writes the rate before the value.
      {"dis6/EntityStatePdu-vbs-articulated-parameters.raw", 16, 8, 0, 128, PartMetric::azimuth,
       -1.5411100387573242, 0, 0},
      {"dis6/EntityStatePdu-vbs-articulated-parameters.raw", 16, 8, 3, 138, PartMetric::elevation,
       0.07811719179153442, 0, 1},
      {"dis7/EntityStatePdu-articulated_parts.raw", 2, 2, 1, 138, PartMetric::elevation,
       1.2814699411392212, 0, 1},
  }};
  for (const Recorded& expected : all) {
    SCOPED_TRACE(expected.file);
    std::ifstream in(reckon::test::reference_data() / "dis-captures/real-pdus" / expected.file,
                     std::ios::binary);
    const std::vector<char> chars((std::istreambuf_iterator<char>(in)), {});
    pdu::EntityState received;
    ASSERT_EQ(pdu::decode(std::as_bytes(std::span(chars)), received), pdu::DecodeError::none);
    PartState state;
    const PartReading reading = from_wire(received.variable_parameters, state);
    EXPECT_EQ(reading.taken, expected.records);
    ASSERT_EQ(state.parameters().size(), expected.parts);
    const PartParameter& p = state.parameters()[expected.index];
    EXPECT_EQ(p.part, expected.part);
    EXPECT_EQ(p.metric, expected.metric);
    EXPECT_EQ(p.value, expected.value);
    EXPECT_EQ(p.rate, expected.rate);
    EXPECT_EQ(p.attached_to, expected.attached_to);
  }
}

TEST(Articulation, SkipsAndCountsBadRecords) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  const auto infinity = std::numeric_limits<float>::infinity();
  const auto octets = together({
      record(kTurret, 12, 0.5F),        // a rate before its value
      record(kTurret, 11, 1.0F),        //
      record(kTurret, 11, 2.0F, 3, 9),  // the last one applies
      record(kGun, 13, nan),            //
      record(kGun, 14, 1.0F),           // its rate has no value then
      record(96, 1, 0.5F),              //
      record(96, 2, infinity),          // the value stays, with rate 0
      record(97, 0, 1.0F),              // metrics outside the list
      record(97, 17, 1.0F),             //
      record(97, 31, 1.0F),             //
  });
  PartState state;
  ASSERT_TRUE(state.set(parameter(99, PartMetric::x, 1)));  // from an earlier update
  const PartReading reading = from_wire(octets, state);
  EXPECT_EQ(reading.taken, 4u);
  EXPECT_EQ(reading.not_finite, 2u);
  EXPECT_EQ(reading.no_value, 1u);
  EXPECT_EQ(reading.unknown, 3u);
  ASSERT_EQ(state.parameters().size(), 2u);
  const PartParameter* turret = state.find(kTurret, PartMetric::azimuth);
  ASSERT_NE(turret, nullptr);
  EXPECT_EQ(turret->value, 2);
  EXPECT_EQ(turret->rate, 0.5);
  EXPECT_EQ(turret->attached_to, 3);
  EXPECT_EQ(turret->change, 9);
  EXPECT_EQ(state.find(96, PartMetric::position)->rate, 0);
}

TEST(Articulation, SkipsOtherAndTruncatedRecords) {
  auto octets = together({record(kTurret, 11, 1.0F), record(kGun, 13, 1.0F)});
  octets[0] = std::byte{1};  // an attached part
  octets.resize(octets.size() + 15, std::byte{0});
  PartState state;
  EXPECT_EQ(from_wire(octets, state).taken, 1u);
  ASSERT_EQ(state.parameters().size(), 1u);
  EXPECT_EQ(state.parameters()[0].part, kGun);
  EXPECT_EQ(from_wire({}, state).taken, 0u);
  EXPECT_TRUE(state.parameters().empty());
}

TEST(Articulation, FillsItsCapacityAndCountsTheRest) {
  std::vector<std::byte> octets;
  for (std::uint32_t i = 0; i < 255; ++i) {
    const auto r = record(i, 11, static_cast<float>(i) * 0.01F);
    octets.insert(octets.end(), r.begin(), r.end());
  }
  PartState state;
  const PartReading reading = from_wire(octets, state);
  EXPECT_EQ(reading.taken, PartState::kCapacity);
  EXPECT_EQ(reading.no_room, 255 - PartState::kCapacity);
  EXPECT_FALSE(state.set(parameter(1000, PartMetric::x, 1)));
  EXPECT_TRUE(state.set(parameter(31, PartMetric::azimuth, 2))) << "it is there already";
  state.remove(31, PartMetric::azimuth);
  EXPECT_TRUE(state.set(parameter(1000, PartMetric::x, 1)));
}

TEST(Articulation, StaysFiniteAndInRangeForAnyOctets) {
  Random random(2);
  std::vector<std::byte> octets(16 * 40);
  for (int round = 0; round < 5000; ++round) {
    for (std::byte& octet : octets) octet = static_cast<std::byte>(random.real(0, 256));
    for (std::size_t i = 0; i < octets.size(); i += 16) {
      octets[i] = static_cast<std::byte>(random.real(0, 1.2));
      octets[i + 7] = static_cast<std::byte>(random.real(0, 40));
    }
    PartState state;
    const PartReading r = from_wire(octets, state);
    ASSERT_LE(r.taken + r.no_room + r.no_value + r.not_finite + r.unknown, 40u);
    PartConvergence shown;
    shown.update(state, 0, 0.1);
    shown.update(state, 1, 1.1);
    for (std::size_t i = 0; i < state.parameters().size(); ++i) {
      const PartParameter& p = state.parameters()[i];
      for (const double t : {0.0, -1.0, 1.15, 12.0, 1e300, kNan}) {
        const PartMotion a = predict(p, t), b = shown.shown(i, t);
        ASSERT_TRUE(std::isfinite(a.value) && std::isfinite(a.rate));
        ASSERT_TRUE(std::isfinite(b.value) && std::isfinite(b.rate));
        if (!is_angle(p.metric)) continue;
        ASSERT_TRUE(a.value > -kPi - 1e-15 && a.value <= kPi);
        ASSERT_TRUE(b.value > -kPi - 1e-15 && b.value <= kPi);
      }
    }
    EXPECT_EQ(should_send(state, PartState(), 1), !state.parameters().empty());
  }
}

}  // namespace
}  // namespace reckon::deadreckon::test

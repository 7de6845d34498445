// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The compact form: every field is restored exactly or within half a quantum, or the encoder
// declines; the decoder accepts any octets safely.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "reckon/pdu/compression/bit_stream.hpp"
#include "reckon/pdu/compression/compact_state.hpp"

namespace reckon::pdu::compression_test {
namespace {

using Random = std::mt19937_64;

std::span<std::byte> front(std::span<std::byte> octets, std::size_t count) {
  return octets.first(count);
}

double between(Random& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

Vector3Float vector(Random& random, double most) {
  const auto one = [&] { return static_cast<float>(between(random, -most, most)); };
  return {one(), one(), one()};
}

EntityState random_state(Random& random) {
  EntityState state;
  state.header.exercise_id = 3;
  state.header.timestamp = static_cast<std::uint32_t>(random());
  state.entity_id = {7, 1, static_cast<std::uint16_t>(random())};
  state.force_id = static_cast<ForceId>(random() % 4);
  state.entity_type = {EntityKind::platform,
                       EntityDomain::land,
                       static_cast<std::uint16_t>(random()),
                       static_cast<std::uint8_t>(random()),
                       static_cast<std::uint8_t>(random()),
                       0,
                       9};
  if (random() % 2 == 0) state.alternative_entity_type = state.entity_type;
  state.linear_velocity = vector(random, 300.0);
  state.location = {between(random, -7e6, 7e6), between(random, -7e6, 7e6),
                    between(random, -7e6, 7e6)};
  state.orientation = {static_cast<float>(between(random, -3.1, 3.1)),
                       static_cast<float>(between(random, -1.5, 1.5)),
                       static_cast<float>(between(random, -3.1, 3.1))};
  state.appearance = static_cast<std::uint32_t>(random());
  state.dead_reckoning.algorithm = static_cast<DeadReckoningAlgorithm>(random() % 10);
  if (random() % 3 == 0) state.dead_reckoning.other_parameters[random() % 15] = 0x5A;
  state.dead_reckoning.linear_acceleration = vector(random, 20.0);
  state.dead_reckoning.angular_velocity = vector(random, 5.0);
  state.marking.set("LONG NAME 7");
  state.capabilities = static_cast<std::uint32_t>(random() % 16);
  return state;
}

void expect_near(const Vector3Float& a, const Vector3Float& b, double most) {
  EXPECT_NEAR(a.x, b.x, most);
  EXPECT_NEAR(a.y, b.y, most);
  EXPECT_NEAR(a.z, b.z, most);
}

TEST(BitStream, RestoresNumbersOfAnyWidth) {
  Random random(1);
  for (int round = 0; round < 2000; ++round) {
    std::array<std::byte, 256> octets;
    std::vector<std::pair<std::uint32_t, unsigned>> said;
    BitWriter writer(octets);
    for (std::size_t i = random() % 50; i > 0; --i) {
      const auto bits = static_cast<unsigned>(random() % 33);
      const auto value = static_cast<std::uint32_t>(random() & ((1ULL << bits) - 1));
      writer.put(value, bits);
      said.emplace_back(value, bits);
    }
    BitReader reader{front(octets, writer.finish())};
    for (const auto& [value, bits] : said) ASSERT_EQ(reader.take(bits), value) << bits;
    EXPECT_TRUE(reader.at_end());
    static_cast<void>(reader.take(32));
    EXPECT_TRUE(reader.overran());
  }
  std::array<std::byte, 3> few;
  BitWriter writer(few);
  writer.put(1, 25);
  EXPECT_EQ(writer.finish(), 0u) << "no room";
}

TEST(BitStream, RestoresTriplesOfAnyWidthWithinItsRoom) {
  Random random(7);
  for (int round = 0; round < 5000; ++round) {
    std::array<std::byte, 96> octets;
    octets.fill(std::byte{0xA5});
    const std::size_t room = random() % 80;
    BitWriter writer(front(octets, room));
    std::vector<std::pair<std::array<std::uint64_t, 3>, unsigned>> said;
    std::size_t bits = 0;
    for (std::size_t i = random() % 5; i > 0; --i) {
      const auto width = static_cast<unsigned>(random() % 57);
      const std::array<std::uint64_t, 3> three = {random(), random(), random()};
      writer.put_three(three, width);
      said.emplace_back(three, width);
      bits += 3 * width;
    }
    const std::size_t size = writer.finish();
    for (std::size_t i = room; i < octets.size(); ++i) ASSERT_EQ(octets[i], std::byte{0xA5});
    ASSERT_EQ(size, (bits + 7) / 8 <= room ? (bits + 7) / 8 : 0);
    if (size == 0) continue;
    BitReader together{front(octets, size)}, each{front(octets, size)};
    for (const auto& [three, width] : said) {
      const std::uint64_t mask = (std::uint64_t{1} << width) - 1;
      const auto back = together.take_three(width);
      for (std::size_t i = 0; i < 3; ++i) {
        ASSERT_EQ(back[i] & mask, three[i] & mask) << width;
        ASSERT_EQ(each.take_wide(width), three[i] & mask) << width;
      }
    }
    EXPECT_TRUE(together.at_end());
    EXPECT_TRUE(each.at_end());
  }
}

// The bound is half a quantum plus the float32 rounding of the sum.
TEST(CompactState, KeepsMotionWithinHalfAQuantum) {
  Random random(2);
  const StateScale scale;
  std::size_t octets = 0;
  constexpr int kRounds = 200'000;
  for (int round = 0; round < kRounds; ++round) {
    const EntityState state = random_state(random);
    std::array<std::byte, kMostCompact> body;
    const std::size_t size = encode_compact(state, scale, body);
    ASSERT_GT(size, 0u);
    octets += size;
    EntityState back;
    back.header.exercise_id = 3;
    back.entity_id = state.entity_id;
    ASSERT_TRUE(decode_compact(front(body, size), state.header.timestamp + 100'000, scale, back));
    EXPECT_EQ(back.header.timestamp, state.header.timestamp);
    EXPECT_EQ(back.dead_reckoning.algorithm, state.dead_reckoning.algorithm);
    EXPECT_TRUE(is_alike(back, state));
    EXPECT_NEAR(back.location.x, state.location.x, 0.5e-3 + 1e-8);
    EXPECT_NEAR(back.location.y, state.location.y, 0.5e-3 + 1e-8);
    EXPECT_NEAR(back.location.z, state.location.z, 0.5e-3 + 1e-8);
    expect_near(back.linear_velocity, state.linear_velocity, 0.5e-2 + 2e-5);
    expect_near({back.orientation.psi, back.orientation.theta, back.orientation.phi},
                {state.orientation.psi, state.orientation.theta, state.orientation.phi},
                0.5e-4 + 5e-7);
    expect_near(back.dead_reckoning.linear_acceleration, state.dead_reckoning.linear_acceleration,
                0.5 * scale.acceleration + 2e-6);
    expect_near(back.dead_reckoning.angular_velocity, state.dead_reckoning.angular_velocity,
                0.5 * scale.turn_rate + 1e-6);
  }
  RecordProperty("mean_octets", static_cast<int>(octets / kRounds));
}

TEST(CompactState, CarriesAQuantisedStateExactly) {
  Random random(3);
  for (int round = 0; round < 20'000; ++round) {
    EntityState state = random_state(random);
    ASSERT_TRUE(quantise(state, {}));
    std::array<std::byte, kMostCompact> body;
    const std::size_t size = encode_compact(state, {}, body);
    EntityState back;
    back.header.exercise_id = 3;
    back.entity_id = state.entity_id;
    ASSERT_TRUE(decode_compact(front(body, size), state.header.timestamp, {}, back));
    std::array<std::byte, 144> a, b;
    ASSERT_EQ(encode(state, a), a.size());
    ASSERT_EQ(encode(back, b), b.size());
    EXPECT_EQ(a, b);
  }
}

TEST(CompactState, DeclinesUnsupportedStates) {
  Random random(4);
  std::array<std::byte, kMostCompact> body;
  const auto declines = [&](auto change) {
    EntityState state = random_state(random);
    change(state);
    return encode_compact(state, {}, body) == 0;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  static const std::array<std::byte, 16> kPart{};
  EXPECT_TRUE(declines([](EntityState& s) { s.variable_parameters = kPart; }));
  EXPECT_TRUE(declines([&](EntityState& s) { s.linear_velocity.y = nan; }));
  EXPECT_TRUE(declines([&](EntityState& s) { s.location.z = nan; }));
  EXPECT_TRUE(declines([&](EntityState& s) { s.orientation.phi = nan; }));
  EXPECT_TRUE(declines([](EntityState& s) { s.linear_velocity.x = 1e9F; }));
  EXPECT_TRUE(declines([](EntityState& s) { s.location.x = 1e18; }));
  EXPECT_TRUE(declines([](EntityState& s) { s.header.pdu_status = 1; }));
  EXPECT_TRUE(declines([](EntityState& s) { s.header.protocol_version = 6; }));
  EXPECT_FALSE(declines([](EntityState&) {}));
  EXPECT_EQ(encode_compact(random_state(random), {}, front(body, 100)), 0u);
}

TEST(CompactState, EncodesHalfATurnAsTheLeastNumber) {
  EntityState state;
  state.orientation.psi = static_cast<float>(std::numbers::pi);
  const auto numbers = numbers_of(state, {});
  ASSERT_TRUE(numbers);
  EXPECT_EQ(numbers->orientation[0], -32768);
}

TEST(CompactState, DecodesAnyOctetsSafely) {
  Random random(5);
  std::array<std::byte, kMostCompact> body;
  std::size_t taken = 0;
  for (int round = 0; round < 200'000; ++round) {
    std::size_t size = encode_compact(random_state(random), {}, body);
    for (std::size_t i = random() % 4; i > 0; --i) {
      body[random() % size] = static_cast<std::byte>(random());
    }
    if (random() % 2 == 0) size = random() % (size + 1);
    EntityState out;
    taken += decode_compact(front(body, size), 0, {}, out) ? 1 : 0;
  }
  EXPECT_GT(taken, 0u);
}

TEST(TimestampNear, CoversTheRecentPastAndNearFuture) {
  constexpr std::uint32_t kSecond = 1'193'046;  // 2^32 / 3600
  for (const std::uint32_t base : {0U, 5U, 0x80000000U, 0xFFFFFFFEU}) {
    for (const std::int32_t off :
         {-3 * static_cast<int>(kSecond) / 2, -70'000, -1, 0, 1, static_cast<int>(kSecond) / 5}) {
      const std::uint32_t time = base + static_cast<std::uint32_t>(off);
      EXPECT_EQ(timestamp_near(time & ((1U << kTimestampBits) - 1), base), time) << off;
    }
  }
}

TEST(StateNumbers, DifferWhereAnythingButTheMotionDiffers) {
  Random random(5);
  const EntityState state = random_state(random);
  const auto unlike = [&](auto change) {
    EntityState other = state;
    change(other);
    return !is_alike(state, other) && !is_alike(other, state);
  };
  EXPECT_TRUE(unlike([](EntityState& one) { ++one.header.exercise_id; }));
  EXPECT_TRUE(unlike([](EntityState& one) { ++one.header.pdu_status; }));
  EXPECT_TRUE(unlike([](EntityState& one) { ++one.entity_id.entity; }));
  EXPECT_TRUE(unlike([](EntityState& one) { one.appearance ^= 1; }));
  EXPECT_TRUE(unlike([](EntityState& one) { one.capabilities ^= 1; }));
  EXPECT_TRUE(unlike([](EntityState& one) { ++one.entity_type.country; }));
  EXPECT_TRUE(unlike([](EntityState& one) { ++one.alternative_entity_type.extra; }));
  EXPECT_TRUE(unlike([](EntityState& one) { ++one.marking.text[0]; }));
  EXPECT_TRUE(unlike([](EntityState& one) {
    one.force_id = static_cast<ForceId>(static_cast<int>(one.force_id) ^ 1);
  }));
  EXPECT_FALSE(unlike([](EntityState& one) { one.linear_velocity.x += 1.0F; }));
}

}  // namespace
}  // namespace reckon::pdu::compression_test

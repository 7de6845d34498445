// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The residual form: exact on quantised states after any loss, or it reports that it awaits a key;
// never a wrong state.
#include "reckon/deadreckon/residual/residual_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "reckon/pdu/compression/compact_state.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::deadreckon::residual_state_test {
namespace {

using Random = std::mt19937_64;
using pdu::EntityState;

constexpr double kTicks = 4294967294.0 / 3600.0;  // ticks of a timestamp in 1 s

/// A vehicle that oscillates about a drift; `rate` [1/s] of its oscillations.
struct Mover {
  std::array<double, 3> size, rate, phase;
  explicit Mover(Random& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
      size[i] = 30 * unit(random);
      rate[i] = 0.05 + 0.6 * unit(random);
      phase[i] = 6.0 * unit(random);
    }
  }
  [[nodiscard]] EntityState at(double t, pdu::DeadReckoningAlgorithm algorithm) const {
    const auto sine = [&](std::size_t i) { return std::sin(rate[i] * t + phase[i]); };
    const auto cosine = [&](std::size_t i) { return std::cos(rate[i] * t + phase[i]); };
    const auto v = [&](std::size_t i) { return static_cast<float>(size[i] * rate[i] * cosine(i)); };
    const auto a = [&](std::size_t i) {
      return static_cast<float>(-size[i] * rate[i] * rate[i] * sine(i));
    };
    EntityState state;
    state.entity_id = {7, 1, 5};
    state.marking.set("MOVER");
    state.header.timestamp = static_cast<std::uint32_t>(static_cast<std::uint64_t>(t * kTicks));
    state.location = {3.8e6 + 9 * t + size[0] * sine(0), 6e5 + size[1] * sine(1),
                      5e6 + size[2] * sine(2)};
    state.linear_velocity = {9 + v(0), v(1), v(2)};
    state.orientation = {static_cast<float>(std::remainder(0.4 * t, 6.283)),
                         static_cast<float>(0.5 * sine(1)), static_cast<float>(0.3 * sine(2))};
    state.dead_reckoning.algorithm = algorithm;
    state.dead_reckoning.linear_acceleration = {a(0), a(1), a(2)};
    state.dead_reckoning.angular_velocity = {0, 0, 0.4F};
    EXPECT_TRUE(pdu::quantise(state, {}));
    return state;
  }
};

bool equal(const EntityState& a, const EntityState& b) {
  return pdu::numbers_of(a, {}) == pdu::numbers_of(b, {}) && pdu::is_alike(a, b);
}

struct Tally {
  int arrived = 0, waited = 0, wrong = 0, plain = 0;
  double octets = 0;
};

/// Some 500 updates with loss rate `loss`, one in 33 of them a key.
Tally run(std::uint64_t seed, double loss, pdu::DeadReckoningAlgorithm algorithm) {
  Random random(seed);
  const Mover mover(random);
  std::bernoulli_distribution lost(loss);
  std::uniform_real_distribution<double> gap(0.05, 1.5);
  ResidualEncoder sender;
  ResidualDecoder receiver;
  Tally result;
  double t = 100.0;
  for (int i = 0; i < 500; ++i, t += gap(random)) {
    const EntityState state = mover.at(t, algorithm);
    std::array<std::byte, kMostResidual> body;
    const std::size_t size = i % 33 == 0 ? 0 : sender.encode(state, body);
    if (size == 0) sender.note_key(state);
    result.plain += size == 0 ? 1 : 0;
    result.octets += size == 0 ? 144.0 : static_cast<double>(size);
    if (i > 0 && lost(random)) continue;
    ++result.arrived;
    EntityState back = state;
    back.location = {};
    if (size == 0) {
      receiver.note_plain(state);
      continue;
    }
    const auto verdict =
        receiver.decode(std::span(body).first(size), state.header.timestamp + 5000, back);
    EXPECT_NE(verdict, ResidualVerdict::malformed);
    result.waited += verdict == ResidualVerdict::no_key ? 1 : 0;
    result.wrong += verdict == ResidualVerdict::good && !equal(back, state) ? 1 : 0;
  }
  return result;
}

class ResidualLoss : public ::testing::TestWithParam<pdu::DeadReckoningAlgorithm> {};

TEST_P(ResidualLoss, IsExactAndSeldomAwaitsAKey) {
  for (const double loss : {0.0, 0.01, 0.05, 0.2, 0.5}) {
    Tally all;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const Tally one = run(seed, loss, GetParam());
      all.arrived += one.arrived;
      all.waited += one.waited;
      all.wrong += one.wrong;
      all.octets += one.octets;
    }
    std::printf("loss %.2f: %.1f octets, %d of %d await a key\n", loss, all.octets / (40 * 500),
                all.waited, all.arrived);
    EXPECT_EQ(all.wrong, 0);
    if (loss <= 0.01) {
      EXPECT_EQ(all.waited, 0);
    }
    if (loss <= 0.2) {
      EXPECT_LE(all.waited, all.arrived / 500);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Models, ResidualLoss,
                         ::testing::Values(pdu::DeadReckoningAlgorithm::rvw,
                                           pdu::DeadReckoningAlgorithm::rvb));

TEST(ResidualState, SendsPlainWhenMoreThanTheMotionChanges) {
  Random random(1);
  const Mover mover(random);
  const auto body_after = [&](auto change) {
    ResidualEncoder sender;
    EXPECT_TRUE(sender.note_key(mover.at(1.0, pdu::DeadReckoningAlgorithm::rvw)));
    EntityState state = mover.at(2.0, pdu::DeadReckoningAlgorithm::rvw);
    change(state);
    std::array<std::byte, kMostResidual> body;
    return sender.encode(state, body);
  };
  static const std::array<std::byte, 16> kPart{};
  EXPECT_GT(body_after([](EntityState&) {}), 0u);
  EXPECT_EQ(body_after([](EntityState& s) { s.appearance ^= 1; }), 0u);
  EXPECT_EQ(body_after([](EntityState& s) { s.marking.set("OTHER"); }), 0u);
  EXPECT_EQ(body_after([](EntityState& s) { s.variable_parameters = kPart; }), 0u);
  EXPECT_EQ(body_after([](EntityState& s) { s.header.pdu_status = 2; }), 0u);
  EXPECT_EQ(body_after([](EntityState& s) { s.dead_reckoning.other_parameters[3] = 1; }), 0u);
  EXPECT_EQ(body_after([](EntityState& s) { s.location.x += 1e6; }), 0u)
      << "farther than it reaches";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(body_after([&](EntityState& s) { s.orientation.psi = nan; }), 0u);
  ResidualEncoder keyless;
  std::array<std::byte, kMostResidual> body;
  EXPECT_EQ(keyless.encode(mover.at(1.0, pdu::DeadReckoningAlgorithm::rvw), body), 0u);
}

TEST(ResidualState, AwaitsTheKeyOfAnotherAppearance) {
  Random random(2);
  const Mover mover(random);
  ResidualEncoder sender;
  ResidualDecoder receiver;
  const EntityState first = mover.at(1.0, pdu::DeadReckoningAlgorithm::rvw);
  receiver.note_plain(first);
  EntityState second = mover.at(2.0, pdu::DeadReckoningAlgorithm::rvw);
  second.appearance = 77;
  ASSERT_TRUE(sender.note_key(second));  // lost
  EntityState third = mover.at(2.5, pdu::DeadReckoningAlgorithm::rvw);
  third.appearance = 77;
  std::array<std::byte, kMostResidual> body;
  const std::size_t size = sender.encode(third, body);
  ASSERT_GT(size, 0u);
  EntityState out = first;
  const auto octets = std::span(body).first(size);
  EXPECT_EQ(receiver.decode(octets, third.header.timestamp, out), ResidualVerdict::no_key);
  EXPECT_TRUE(equal(out, first)) << "untouched";
  receiver.note_plain(second);
  EXPECT_EQ(receiver.decode(octets, third.header.timestamp, out), ResidualVerdict::good);
  EXPECT_TRUE(equal(out, third));
  ResidualDecoder newcomer;
  EXPECT_EQ(newcomer.decode(octets, third.header.timestamp, out), ResidualVerdict::no_key);
}

/// A vehicle that turns ever faster; a step is half a second.
EntityState turning_vehicle(int step) {
  const double t = 0.5 * step;
  EntityState state;
  state.header.timestamp = 0x10000001U + 2U * 298261U * static_cast<unsigned>(step);
  state.entity_id = {7, 1, 5};
  state.force_id = pdu::ForceId::friendly;
  state.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 1, 3, 0};
  state.appearance = 0x00400001;
  state.marking.set("GOLDEN");
  state.capabilities = 3;
  state.location = {3.8e6 + 12.0 * t + 0.7 * t * t, 6e5 - 3.0 * t, 5e6 + 0.25 * t};
  state.linear_velocity = {static_cast<float>(12.0 + 1.4 * t), -3.0F, 0.25F};
  state.orientation = {static_cast<float>(0.3 + 0.05 * t), -0.4F, 3.1F};
  auto& rates = state.dead_reckoning;
  rates.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  rates.linear_acceleration = {1.4F, 0.0F, -0.05F * static_cast<float>(step)};
  rates.angular_velocity = {0.0F, 0.0F, 0.05F + 0.01F * static_cast<float>(step)};
  EXPECT_TRUE(pdu::quantise(state, {}));
  return state;
}

TEST(ResidualState, WritesAndReadsTheReferenceOctets) {
  const EntityState first = turning_vehicle(0);
  std::array<std::byte, pdu::kMostCompact> key;
  const std::size_t key_size = pdu::encode_compact(first, {}, key);
  const auto stored = reckon::test::octets_from_hex(
      "000008244713FB300047868C009502F900312C3B5006601873DF68FC9C670000A002BAF7808080F0808081942000"
      "8"
      "780A3A7A6702222A7080180");
  EXPECT_TRUE(std::ranges::equal(std::span(key).first(key_size), stored));
  EntityState back;
  back.entity_id = first.entity_id;
  ASSERT_TRUE(pdu::decode_compact(stored, first.header.timestamp, {}, back));
  EXPECT_TRUE(equal(back, first));

  ResidualEncoder sender;
  ResidualDecoder receiver;
  ASSERT_TRUE(sender.note_key(first));
  receiver.note_plain(back);
  int step = 0;
  for (const char* hex :
       {"79C348D15A4109127DDA49D303649F4D", "FDBC91A2AA49119E43F6993A76077299E234",
        "70E6DA73FA49122F47F6993A060684A33DF677"}) {
    const EntityState state = turning_vehicle(++step);
    std::array<std::byte, kMostResidual> body;
    const std::size_t size = sender.encode(state, body);
    const auto known = reckon::test::octets_from_hex(hex);
    EXPECT_TRUE(std::ranges::equal(std::span(body).first(size), known)) << step;
    EXPECT_EQ(receiver.decode(known, state.header.timestamp, back), ResidualVerdict::good) << step;
    EXPECT_TRUE(equal(back, state)) << step;
  }
}

TEST(ResidualState, DecodesAnyOctetsSafely) {
  Random random(3);
  const Mover mover(random);
  ResidualEncoder sender;
  ResidualDecoder receiver;
  const EntityState key = mover.at(1.0, pdu::DeadReckoningAlgorithm::rvb);
  ASSERT_TRUE(sender.note_key(key));
  receiver.note_plain(key);
  const EntityState state = mover.at(1.5, pdu::DeadReckoningAlgorithm::rvb);
  std::array<std::byte, kMostResidual> genuine;
  const std::size_t size = sender.encode(state, genuine);
  const reckon::test::AllocationGuard guard;
  int wrong = 0;
  for (int round = 0; round < 200'000; ++round) {
    std::array<std::byte, kMostResidual> body = genuine;
    std::size_t length = random() % 2 == 0 ? size : random() % (kMostResidual + 1);
    for (std::size_t i = random() % 6; i > 0; --i) {
      body[random() % kMostResidual] = static_cast<std::byte>(random());
    }
    ResidualDecoder one = receiver;
    EntityState out = state;
    const auto verdict = one.decode(std::span(body).first(length), state.header.timestamp, out);
    wrong += verdict == ResidualVerdict::good && !equal(out, state) ? 1 : 0;
  }
  EXPECT_LT(wrong, 20) << "one in 65,536 passes the check by chance";
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::deadreckon::residual_state_test

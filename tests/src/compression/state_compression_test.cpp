// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From an owner's update to the state that a receiver takes: compressor, bundles, restorer.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/peer/compression/state_compressor.hpp"
#include "reckon/peer/compression/state_restorer.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"

namespace reckon::peer {
namespace {

using pdu::CompressedForm;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr aoim::GroupIndex kGroup{3};
constexpr pdu::SimulationAddress kSender{7, 1};

constexpr aoim::SourceAddress at_host(std::uint8_t host, std::uint16_t port = 3000) {
  return {{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 10, 0, 0, host}, port};
}
constexpr KeySpeaker kOwner{kSender, 77, at_host(1)};

/// An entity on a circle, its motion in quanta.
pdu::EntityState state_of(std::uint16_t entity, nanoseconds now) {
  const double t = std::chrono::duration<double>(now).count(), turn = 0.3 * t + entity;
  pdu::EntityState state;
  state.entity_id = {kSender.site, kSender.application, entity};
  state.marking.set("CAR");
  state.header.timestamp = pdu::to_dis_timestamp(now, true);
  state.location = {3e6 + 40 * std::cos(turn), 1e6 + 40 * std::sin(turn), 5e6};
  state.linear_velocity = {static_cast<float>(-12 * std::sin(turn)),
                           static_cast<float>(12 * std::cos(turn)), 0};
  state.orientation.psi = static_cast<float>(std::remainder(turn, 6.2831));
  state.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  EXPECT_TRUE(pdu::quantise(state, {}));
  return state;
}

aoim::Aggregator aggregator() {
  aoim::AggregatorConfig config;
  config.sender = kSender;
  return aoim::Aggregator(config);
}

/// One owner of some entities and one receiver; each datagram may be lost.
struct Line {
  explicit Line(CompressedForm asked) : form(asked), decoder(1, counters, asked, 1000) {}

  void send(std::uint16_t entity, nanoseconds now, bool is_new = false) {
    StateCompressor& compressor = compressors.try_emplace(entity, form).first->second;
    const pdu::EntityState state = state_of(entity, now);
    std::array<std::byte, StateCompressor::kRoom> octets;
    const auto made = compressor.compress(state, kGroup, is_new, now, octets);
    if (made.size == 0) {
      EXPECT_EQ(bundler.add(kGroup, state, {}, now), aoim::AddResult::queued);
    } else {
      EXPECT_EQ(bundler.add_compressed(kGroup, state.entity_id, form,
                                       std::span(octets.data(), made.size), {}, now),
                aoim::AddResult::queued);
    }
    expected[entity] = state;
  }
  /// The states that arrive, by entity.
  std::map<std::uint16_t, pdu::EntityState> pass(nanoseconds now, bool lost) {
    std::map<std::uint16_t, pdu::EntityState> taken;
    bundler.set_utc_offset(nanoseconds(0), true);
    bundler.flush_due(now, [&](aoim::GroupIndex, std::span<const std::byte> datagram) {
      sent_octets += datagram.size();
      if (lost) return;
      for (const Inbound& update : decoder.decode(datagram, {}, 0, kOwner)) {
        if (update.has_state) taken[update.entity.entity] = update.state;
      }
    });
    return taken;
  }

  CompressedForm form;
  Counters counters;
  DatagramDecoder decoder;
  aoim::Aggregator bundler = aggregator();
  std::map<std::uint16_t, StateCompressor> compressors;
  std::map<std::uint16_t, pdu::EntityState> expected;
  std::size_t sent_octets = 0;
};

std::uint64_t value_of(const Counters& counters, std::string_view name) {
  const Counter* counter = counters.find(name);
  return counter == nullptr ? 0 : counter->value();
}

class StateCompression : public ::testing::TestWithParam<CompressedForm> {};

TEST_P(StateCompression, RestoresSentStatesUnderLoss) {
  for (const double loss : {0.0, 0.2}) {
    Line line(GetParam());
    std::mt19937_64 random(4);
    std::bernoulli_distribution lost(loss);
    std::size_t sent = 0, arrived = 0, taken = 0;
    nanoseconds now = std::chrono::seconds(10);
    for (int step = 0; step < 400; ++step, now += milliseconds(250)) {
      for (std::uint16_t entity = 1; entity <= 25; ++entity) line.send(entity, now, step == 0);
      const bool gone = step > 0 && lost(random);
      const auto got = line.pass(now, gone);
      sent += 25;
      arrived += gone ? 0 : 25;
      taken += got.size();
      for (const auto& [entity, state] : got) {
        ASSERT_EQ(pdu::numbers_of(state, {}), pdu::numbers_of(line.expected[entity], {}));
        ASSERT_TRUE(pdu::is_alike(state, line.expected[entity]));
      }
    }
    const double ratio = 144.0 * static_cast<double>(sent) / static_cast<double>(line.sent_octets);
    std::printf("form %d, loss %.2f: ratio %.2f with trailers, %zu of %zu used\n",
                static_cast<int>(GetParam()), loss, ratio, taken, arrived);
    EXPECT_GT(ratio, GetParam() == CompressedForm::residual ? 4.0 : 1.5);
    EXPECT_EQ(value_of(line.counters, "malformed_in"), 0u);
    EXPECT_EQ(arrived - taken, value_of(line.counters, "keys_awaited"));
    if (loss == 0.0 || GetParam() == CompressedForm::compact) {
      EXPECT_EQ(taken, arrived);
    } else if (GetParam() == CompressedForm::residual) {
      EXPECT_GT(taken, arrived * 99 / 100);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Forms, StateCompression,
                         ::testing::Values(CompressedForm::compact, CompressedForm::residual));

TEST(StateCompressor, SendsKeysOftenFirstThenRarely) {
  StateCompressor compressor(CompressedForm::residual);
  std::array<std::byte, StateCompressor::kRoom> octets;
  std::string kinds;
  nanoseconds now = std::chrono::seconds(10);
  for (int i = 0; i < 60; ++i, now += milliseconds(100)) {
    const auto made = compressor.compress(state_of(1, now), kGroup, false, now, octets);
    kinds += made.size == 0 ? 'P' : made.is_key ? 'K' : '.';
  }
  EXPECT_EQ(kinds, "PK...K...............K...............................K......");
  const auto crossed = compressor.compress(state_of(1, now), {9}, false, now, octets);
  EXPECT_EQ(crossed.size, 0u) << "who hears the other group knows nothing of it";
  EXPECT_TRUE(crossed.is_key);
}

/// Owners and one receiver, without datagrams between them.
struct Keys {
  explicit Keys(std::size_t capacity = 100) : restorer(kForm, capacity) {}

  /// Sends the entity's first keys, which the receiver gets from `speaker`.
  void tell(std::uint16_t entity, const KeySpeaker& speaker, nanoseconds now) {
    pdu::EntityState state = state_of(entity, now);
    state.entity_id.site = speaker.simulation.site;
    state.entity_id.application = speaker.simulation.application;
    compressors.erase(state.entity_id);
    auto& compressor = compressors.try_emplace(state.entity_id, kForm).first->second;
    std::array<std::byte, StateCompressor::kRoom> octets;
    static_cast<void>(compressor.compress(state, kGroup, true, now, octets));
    static_cast<void>(compressor.compress(state, kGroup, false, now, octets));  // also a key
    restorer.note_plain(state, speaker);
  }
  /// The verdict on a later state of `owner` that arrives from `speaker`.
  RestoreVerdict lean(std::uint16_t entity, const KeySpeaker& owner, const KeySpeaker& speaker,
                      nanoseconds now) {
    pdu::EntityState state = state_of(entity, now);
    state.entity_id.site = owner.simulation.site;
    state.entity_id.application = owner.simulation.application;
    std::array<std::byte, StateCompressor::kRoom> octets;
    const auto made = compressors.at(state.entity_id).compress(state, kGroup, false, now, octets);
    EXPECT_TRUE(made.needs_key && !made.is_key);
    pdu::CompressedStates pdu;
    pdu.header.timestamp = state.header.timestamp;
    pdu.simulation = owner.simulation;
    pdu.form = kForm;
    pdu.number_of_states = 1;
    pdu.states.bytes = std::span(octets.data(), made.size);
    pdu::CompressedStateReader reader(pdu);
    pdu::CompressedState one;
    EXPECT_TRUE(reader.next(one));
    pdu::EntityState out;
    const RestoreVerdict verdict = restorer.restore(pdu, one, speaker, out);
    if (verdict == RestoreVerdict::good) {
      EXPECT_EQ(pdu::numbers_of(out, {}), pdu::numbers_of(state, {}));
    }
    return verdict;
  }

  static constexpr CompressedForm kForm = CompressedForm::residual;
  StateRestorer restorer;
  std::map<pdu::EntityId, StateCompressor> compressors;
};

constexpr nanoseconds kStart = std::chrono::seconds(10);
constexpr nanoseconds kNext = kStart + milliseconds(200);

TEST(OwnedKeys, ForgetTheFirstWhereThereIsNoRoom) {
  Keys keys(2);
  for (std::uint16_t entity = 1; entity <= 3; ++entity) keys.tell(entity, kOwner, kStart);
  EXPECT_EQ(keys.lean(1, kOwner, kOwner, kNext), RestoreVerdict::awaits_key);
  EXPECT_EQ(keys.lean(2, kOwner, kOwner, kNext), RestoreVerdict::good);
  EXPECT_EQ(keys.lean(3, kOwner, kOwner, kNext), RestoreVerdict::good);
}

TEST(OwnedKeys, AreAcceptedAndUsedOnlyFromTheirOwner) {
  const KeySpeaker others[] = {
      {},                         // no peer
      {{9, 9}, 88, at_host(2)},   // another peer
      {{9, 9}, 77, kOwner.from},  // another peer with the owner's epoch and address
      {kSender, 0, kOwner.from},  // a plain program at its host
  };
  for (const KeySpeaker& other : others) {
    Keys keys;
    keys.tell(1, kOwner, kStart);
    pdu::EntityState forged = state_of(1, kStart + milliseconds(100));
    forged.location.x += 60.0;
    keys.restorer.note_plain(forged, other);
    EXPECT_EQ(keys.lean(1, kOwner, other, kNext), RestoreVerdict::not_theirs);
    EXPECT_EQ(keys.lean(1, kOwner, kOwner, kNext + milliseconds(1)), RestoreVerdict::good);
    EXPECT_EQ(keys.restorer.size(), 1U) << "and they cost nothing";
  }
}

TEST(OwnedKeys, EndWithTheEpochOfTheirSender) {
  Keys keys;
  KeySpeaker reborn = kOwner;
  reborn.epoch = 78;
  keys.tell(1, kOwner, kStart);
  EXPECT_EQ(keys.lean(1, kOwner, reborn, kNext), RestoreVerdict::awaits_key);
  keys.tell(1, reborn, kNext);
  EXPECT_EQ(keys.lean(1, reborn, reborn, kNext + milliseconds(100)), RestoreVerdict::good);
  EXPECT_EQ(keys.lean(1, reborn, kOwner, kNext + milliseconds(200)), RestoreVerdict::awaits_key);
  for (std::uint16_t entity = 2; entity <= 90; ++entity) keys.tell(entity, reborn, kNext);
  keys.restorer.forget(reborn.epoch);
  EXPECT_EQ(keys.restorer.size(), 0U);
  EXPECT_EQ(keys.lean(1, reborn, reborn, kNext + milliseconds(300)), RestoreVerdict::awaits_key);
}

TEST(OwnedKeys, FollowTheOwnerToANewAddress) {
  Keys keys;
  KeySpeaker moved = kOwner;
  moved.from = at_host(3);
  keys.tell(1, kOwner, kStart);
  EXPECT_EQ(keys.lean(1, kOwner, moved, kNext), RestoreVerdict::good);
  keys.tell(1, moved, kNext);  // the owner, or a peer that was taken for it while it was silent
  EXPECT_EQ(keys.lean(1, kOwner, moved, kNext + milliseconds(100)), RestoreVerdict::good);
  EXPECT_EQ(keys.lean(1, kOwner, kOwner, kNext + milliseconds(200)), RestoreVerdict::awaits_key);
  keys.tell(1, kOwner, kNext + milliseconds(300));
  EXPECT_EQ(keys.lean(1, kOwner, kOwner, kNext + milliseconds(400)), RestoreVerdict::good);
}

TEST(OwnedKeys, SurviveAHostThatInventsEntities) {
  Keys keys(100);
  for (std::uint16_t entity = 1; entity <= 20; ++entity) keys.tell(entity, kOwner, kStart);
  for (std::uint16_t life = 0; life < 4; ++life) {  // with other names, from other ports
    const auto port = static_cast<std::uint16_t>(4000 + life);
    const KeySpeaker inventor{{9, life}, 90U + life, at_host(2, port)};
    for (std::uint16_t entity = 1; entity <= 1000; ++entity) keys.tell(entity, inventor, kStart);
  }
  EXPECT_EQ(keys.restorer.size(), 100U);
  for (std::uint16_t entity = 1; entity <= 20; ++entity)
    EXPECT_EQ(keys.lean(entity, kOwner, kOwner, kNext), RestoreVerdict::good) << entity;
}

}  // namespace
}  // namespace reckon::peer

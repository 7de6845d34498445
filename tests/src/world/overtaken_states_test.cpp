// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// States in queued datagrams that are already superseded.
#include "reckon/peer/world/overtaken_states.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <deque>
#include <random>
#include <vector>

#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using Octets = std::vector<std::byte>;

pdu::EntityState state_of(std::uint16_t entity, int ms) {
  pdu::EntityState state;
  state.header.exercise_id = 1;
  state.header.timestamp = pdu::to_dis_timestamp(milliseconds(ms), true);
  state.entity_id = {7, 1, entity};
  return state;
}

Arrival from_sender(std::uint8_t last_octet, std::uint32_t epoch = 5) {
  Arrival arrival;
  arrival.epoch = epoch;
  arrival.from.octets[15] = last_octet;
  return arrival;
}

// Queued datagrams.
class Backlog {
 public:
  void add(const std::vector<pdu::EntityState>& states, const Arrival& arrival = from_sender(1)) {
    Octets& octets = octets_.emplace_back();
    for (const pdu::EntityState& state : states) {
      const std::size_t before = octets.size();
      octets.resize(before + pdu::wire_size(state));
      ASSERT_GT(pdu::encode(state, std::span(octets).subspan(before)), 0u);
    }
    waiting.push_back({octets, arrival});
  }
  // Appends a trailer to the last datagram.
  void add_trailer() {
    Octets& octets = octets_.back();
    octets.resize(octets.size() + pdu::kDatagramTrailerSize);
    ASSERT_GT(
        pdu::encode(pdu::DatagramTrailer(), std::span(octets).last(pdu::kDatagramTrailerSize)), 0u);
    waiting.back().octets = octets;
  }
  [[nodiscard]] std::vector<std::uint64_t> overtaken_of_bodies_in_part() {
    return masks(OvertakenStates(1, waiting.size(), true));
  }
  // Whether each datagram is overtaken as a whole.
  [[nodiscard]] std::vector<bool> whole() {
    OvertakenStates overtaken(1, waiting.size());
    overtaken.look(waiting);
    std::vector<bool> whole;
    for (std::size_t i = 0; i < waiting.size(); ++i) whole.push_back(overtaken.is_whole(i));
    return whole;
  }
  [[nodiscard]] std::vector<std::uint64_t> overtaken() {
    return masks(OvertakenStates(1, waiting.size()));
  }

  std::vector<ArrivedDatagram> waiting;

 private:
  [[nodiscard]] std::vector<std::uint64_t> masks(OvertakenStates overtaken) const {
    overtaken.look(waiting);
    std::vector<std::uint64_t> masks;
    for (std::size_t i = 0; i < waiting.size(); ++i) masks.push_back(overtaken.of(i));
    return masks;
  }

  std::deque<Octets> octets_;
};

using Masks = std::vector<std::uint64_t>;

TEST(OvertakenStates, AreAllOfAnEntityButTheNewest) {
  Backlog backlog;
  for (int ms = 0; ms < 500; ms += 10) backlog.add({state_of(1, ms)});
  Masks wanted(50, 1);
  wanted.back() = 0;
  EXPECT_EQ(backlog.overtaken(), wanted);
}

TEST(OvertakenStates, AreMarkedByTheirIndexInTheDatagram) {
  Backlog backlog;
  backlog.add({state_of(1, 0), state_of(2, 0), state_of(3, 0)});
  backlog.add({state_of(4, 10), state_of(3, 10), state_of(1, 10)});
  EXPECT_EQ(backlog.overtaken(), Masks({0b101, 0}));
}

TEST(OvertakenStates, AreOvertakenBySenderAndEpochOnly) {
  Backlog backlog;
  backlog.add({state_of(1, 0)}, from_sender(1, 5));
  backlog.add({state_of(1, 10)}, from_sender(2, 5));  // an impostor or a new owner
  backlog.add({state_of(1, 20)}, from_sender(1, 6));
  EXPECT_EQ(backlog.overtaken(), Masks({0, 0, 0}));
}

TEST(OvertakenStates, NeedIncreasingAndCloseTimestamps) {
  Backlog backlog;
  backlog.add({state_of(1, 100)});
  backlog.add({state_of(1, 100)});
  backlog.add({state_of(2, 100)});
  backlog.add({state_of(2, 50)});
  backlog.add({state_of(3, 100)});
  backlog.add({state_of(3, 1101)});  // several states are needed to detect a leap of the clock
  EXPECT_EQ(backlog.overtaken(), Masks(6, 0));
}

TEST(OvertakenStates, CrossTheEndOfTheHour) {
  Backlog backlog;
  backlog.add({state_of(1, 3'600'000 - 10)});
  backlog.add({state_of(1, 3'600'000 + 10)});
  EXPECT_EQ(backlog.overtaken(), Masks({1, 0}));
}

TEST(OvertakenStates, ExcludeUpdatesWithMoreThanAPose) {
  Backlog backlog;
  pdu::EntityState coupled = state_of(1, 0), leaves = state_of(2, 0), foreign = state_of(3, 10);
  coupled.header.pdu_status = pdu::kStatusCoupledExtension;
  leaves.appearance = pdu::kAppearanceDeactivated;
  foreign.header.exercise_id = 2;
  backlog.add({coupled, leaves, state_of(3, 0)});
  backlog.add({state_of(1, 10), state_of(2, 10), foreign});
  EXPECT_EQ(backlog.overtaken(), Masks({0, 0}));
}

// Where owners omit parts from some updates, the last update with parts counts.
TEST(OvertakenStates, ExcludePartsThatLaterUpdatesMayOmit) {
  const std::vector<std::byte> part(pdu::kFixedSize<pdu::VariableParameter>);
  pdu::EntityState full = state_of(1, 0);
  full.variable_parameters = part;
  Backlog backlog;
  backlog.add({full});
  backlog.add({state_of(1, 10)});
  backlog.add({state_of(1, 20)});
  EXPECT_EQ(backlog.overtaken_of_bodies_in_part(), Masks({0, 1, 0}));
  EXPECT_EQ(backlog.overtaken(), Masks({1, 1, 0}));
}

TEST(OvertakenStates, AreNotOvertakenByDamagedUpdates) {
  Backlog backlog;
  backlog.add({state_of(1, 0)});
  backlog.add({state_of(1, 10)});
  backlog.waiting[1].octets = backlog.waiting[1].octets.first(143);
  EXPECT_EQ(backlog.overtaken(), Masks({0, 0}));
}

TEST(OvertakenStates, DropADatagramOnlyAsAWhole) {
  Backlog backlog;
  backlog.add({state_of(1, 0), state_of(2, 0)});
  backlog.add({state_of(1, 10)});
  backlog.add_trailer();
  backlog.add({state_of(1, 20), state_of(3, 20)});
  backlog.add({state_of(1, 30), state_of(2, 30)});
  EXPECT_EQ(backlog.overtaken(), Masks({0b11, 1, 1, 0}));
  EXPECT_EQ(backlog.whole(), std::vector<bool>({true, true, false, false}));
}

TEST(OvertakenStates, AreNoneOfSendersThatAreTooMany) {
  Backlog backlog;
  for (std::uint8_t sender = 0; sender <= OvertakenStates::kMostSenders; ++sender) {
    backlog.add({state_of(1, 0)}, from_sender(sender));
    backlog.add({state_of(1, 10)}, from_sender(sender));
  }
  const Masks masks = backlog.overtaken();
  EXPECT_EQ(masks[0], 0u);  // the one that exceeds the limit
  for (std::size_t i = 2; i < masks.size(); ++i) EXPECT_EQ(masks[i], i % 2 == 0 ? 1u : 0u) << i;
}

TEST(OvertakenStates, AreSoughtInAnyOctets) {
  std::mt19937 random(2);
  const auto below = [&](std::size_t n) { return random() % n; };
  OvertakenStates overtaken(1, 32);
  for (int run = 0; run < 2000; ++run) {
    std::deque<Octets> octets;
    std::vector<ArrivedDatagram> waiting;
    for (std::size_t i = below(33); i > 0; --i) {
      pdu::EntityState state = state_of(static_cast<std::uint16_t>(below(3)), run % 1000);
      Octets& one = octets.emplace_back(2 * pdu::wire_size(state));
      for (std::size_t at : {std::size_t{0}, one.size() / 2})
        ASSERT_GT(pdu::encode(state, std::span(one).subspan(at)), 0u);
      for (std::size_t flips = below(4); flips > 0; --flips)
        one[below(one.size())] = static_cast<std::byte>(random());
      one.resize(below(2) == 0 ? one.size() : below(one.size() + 1));
      one.shrink_to_fit();
      waiting.push_back({one, from_sender(static_cast<std::uint8_t>(below(2)))});
    }
    overtaken.look(waiting);
    for (std::size_t i = 0; i < waiting.size(); ++i)
      ASSERT_TRUE(!overtaken.is_whole(i) || overtaken.of(i) != 0);
  }
}

// Compared with the plain rule, for few entities and senders in random order.
TEST(OvertakenStates, MatchThePlainRule) {
  std::mt19937 random(1);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int run = 0; run < 50; ++run) {
    struct Told {
      std::size_t datagram;
      int entity, sender, ms;
      bool coupled;
    };
    std::vector<Told> told;
    Backlog backlog;
    for (std::size_t datagram = 0; datagram < 40; ++datagram) {
      const int sender = below(2);
      std::vector<pdu::EntityState> states;
      for (int i = below(6); i >= 0; --i) {
        const Told one{datagram, below(8), sender, static_cast<int>(datagram) * 40 + below(100),
                       below(8) == 0};
        told.push_back(one);
        states.push_back(state_of(static_cast<std::uint16_t>(one.entity), one.ms));
        if (one.coupled) states.back().header.pdu_status = pdu::kStatusCoupledExtension;
      }
      backlog.add(states, from_sender(static_cast<std::uint8_t>(sender)));
    }
    const Masks masks = backlog.overtaken();
    std::vector<std::size_t> place(40, 0);
    for (const Told& one : told) {
      // The last state; within a datagram the first.
      const Told* last = nullptr;
      for (const Told& other : told) {
        if (other.entity != one.entity || other.sender != one.sender) continue;
        if (last == nullptr || other.datagram > last->datagram) last = &other;
      }
      const int older = last->ms - one.ms;
      const bool wanted =
          last->datagram > one.datagram && !one.coupled && older > 0 && older < 1000;
      const std::size_t pdu = place[one.datagram]++;
      ASSERT_EQ((masks[one.datagram] >> pdu & 1) != 0, wanted) << "run " << run;
    }
  }
}

TEST(OvertakenStates, AreFoundAgainEachTimeWithoutAllocation) {
  Backlog first, second;
  first.add({state_of(1, 0)});
  first.add({state_of(1, 10)});
  second.add({state_of(1, 5)});
  second.add({state_of(2, 5)});
  OvertakenStates overtaken(1, 2);
  test::AllocationGuard guard;
  overtaken.look(first.waiting);
  EXPECT_EQ(overtaken.count(), 1u);
  overtaken.look(second.waiting);
  EXPECT_EQ(overtaken.count(), 0u);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::peer

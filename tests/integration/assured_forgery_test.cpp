// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Assured records and acknowledgements from hosts that may not send them, and by unicast.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/tests/integration/federates.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using peer::Delivery;
using peer::Federate;
using std::chrono::nanoseconds;
using Octets = std::vector<std::byte>;

constexpr std::uint32_t kEpoch0 = 100, kEpoch1 = 101;

template <pdu::Pdu T>
Octets encoded(const T& message) {
  Octets octets(pdu::wire_size(message));
  octets.resize(pdu::encode(message, octets));
  return octets;
}

Octets joined(const Octets& a, const Octets& b) {
  Octets both = a;
  both.insert(both.end(), b.begin(), b.end());
  return both;
}

pdu::Fire fire(std::uint32_t number) {
  pdu::Fire result;
  result.header.exercise_id = 1;
  result.firing_entity_id = {1, 1, 900};
  result.fire_mission_index = number;
  return result;
}

// A record in the name of the peer with this epoch.
struct Forged {
  std::uint32_t sequence = 1;
  std::uint32_t epoch = kEpoch0;
  std::uint32_t to = kEpoch1;
  pdu::AssuredKind kind = pdu::AssuredKind::record;

  [[nodiscard]] Octets holding(const Octets& content) const {
    pdu::AssuredRecord record;
    record.header.exercise_id = 1;
    record.kind = kind;
    record.flags = pdu::kAssuredPdu;
    record.epoch = epoch;
    record.sequence = sequence;
    Octets addressee(4);
    pdu::store_big_endian(addressee.data(), to);
    record.addressees = addressee;
    record.content = pdu::OctetBlock<std::uint16_t>::of(content);
    return encoded(record);
  }
};

// The receiver's link: datagrams of the attacker seem to come from where the attacker wants, and
// records to groups are lost on request.
class DisguisingLink final : public peer::LinkAround {
 public:
  DisguisingLink(peer::Link& inner, const peer::IpEndpoint& attacker)
      : LinkAround(inner), inner_(inner), attacker_(attacker) {}
  bool send(const peer::IpEndpoint& to, std::span<const std::byte> bytes) noexcept override {
    if (loses_records && to.is_multicast() && holds_record(bytes)) return true;
    return inner_.send(to, bytes);
  }
  std::size_t receive(std::span<peer::Datagram> out) noexcept override {
    const std::size_t count = inner_.receive(out);
    for (peer::Datagram& datagram : out.first(count)) {
      if (datagram.sender == attacker_ && disguise.port != 0) datagram.sender = disguise;
    }
    return count;
  }
  [[nodiscard]] std::size_t max_payload() const noexcept override { return inner_.max_payload(); }

  peer::IpEndpoint disguise;
  bool loses_records = false;

 private:
  static bool holds_record(std::span<const std::byte> bytes) noexcept {
    for (const pdu::BundledPdu& pdu : pdu::BundleReader(bytes)) {
      if (pdu.header.pdu_type == pdu::PduType::assured_record) return true;
    }
    return false;
  }
  peer::Link& inner_;
  peer::IpEndpoint attacker_;
};

class AssuredForgery : public testing::Test {
 protected:
  AssuredForgery() : clock_(1s, 1h), network_({.links = 3}, clock_), attacker_(network_.link(2)) {
    network_.impair(Federates::delayed(200us));
    for (std::size_t i = 0; i < 2; ++i) {
      links_[i] = std::make_unique<DisguisingLink>(network_.link(i), attacker_.local_endpoint());
      peer::FederateOptions options;
      options.scene = scene();
      options.application = static_cast<std::uint16_t>(i + 1);
      federates_[i] = std::make_unique<Federate>(options, *links_[i], clock_,
                                                 static_cast<std::uint32_t>(kEpoch0 + i));
      federates_[i]->publish<pdu::Fire>();
      federates_[i]->subscribe<pdu::Fire>(
          [this, i](const pdu::Fire& shot) { shots_[i].push_back(shot.fire_mission_index); });
    }
    run(2s);
  }
  static peer::SceneFile scene() {
    peer::SceneFile result = *peer::dis_exercise(1);
    result.network.interop = false;
    return result;
  }
  void run(nanoseconds span) {
    for (const nanoseconds end = clock_.now() + span; clock_.now() < end;) {
      clock_.advance(500us);
      for (const auto& federate : federates_) federate->step();
    }
  }
  [[nodiscard]] peer::IpEndpoint endpoint(std::size_t link) {
    return network_.link(link).local_endpoint();
  }
  // The attacker's datagram to the second peer alone, from the first peer's address unless changed.
  void to_host(const Octets& octets) {
    ASSERT_TRUE(attacker_.send(endpoint(1), octets));
    run(20ms);
  }
  void to_group(const Octets& octets) {
    ASSERT_TRUE(attacker_.send(peer::pool_of(scene()).base(), octets));
    run(20ms);
  }
  std::uint64_t count(std::size_t i, const char* counter) {
    const peer::Counter* found = federates_[i]->peer().counters().find(counter);
    return found == nullptr ? 0 : found->value();
  }

  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  peer::Link& attacker_;
  std::array<std::unique_ptr<DisguisingLink>, 2> links_;
  std::array<std::unique_ptr<Federate>, 2> federates_;
  std::array<std::vector<std::uint32_t>, 2> shots_;
};

TEST_F(AssuredForgery, UnicastFromAnotherAddressOrPortIsRefused) {
  to_host(Forged{}.holding(encoded(fire(1))));
  links_[1]->disguise = endpoint(0);
  ++links_[1]->disguise.port;
  to_host(Forged{}.holding(encoded(fire(2))));
  EXPECT_TRUE(shots_[1].empty());
  EXPECT_EQ(count(1, "unicast_refused"), 2U);
  --links_[1]->disguise.port;
  to_host(Forged{}.holding(encoded(fire(3))));
  EXPECT_EQ(shots_[1], std::vector<std::uint32_t>{3}) << "the peer's own address and port";
}

TEST_F(AssuredForgery, UnicastOfAnythingElseIsRefused) {
  links_[1]->disguise = endpoint(0);
  const Octets record = Forged{}.holding(encoded(fire(1)));
  pdu::DatagramTrailer trailer;
  trailer.header.exercise_id = 1;
  trailer.epoch = kEpoch0;
  Octets other_exercise = record;
  other_exercise[1] = std::byte{2};
  const Octets stranger = Forged{.epoch = 999}.holding(encoded(fire(1)));
  const Octets another = Forged{.epoch = kEpoch1}.holding(encoded(fire(1)));
  const Octets cut(record.begin(), record.end() - 1);
  const std::vector<Octets> refused{joined(encoded(fire(1)), record),
                                    joined(record, encoded(trailer)),
                                    joined(record, another),
                                    encoded(fire(1)),
                                    joined(record, other_exercise),
                                    stranger,
                                    another,
                                    cut};
  for (const Octets& octets : refused) to_host(octets);
  EXPECT_EQ(count(1, "unicast_refused"), refused.size());
  EXPECT_TRUE(shots_[1].empty());
}

TEST_F(AssuredForgery, ReplayIsDeliveredOnce) {
  links_[1]->disguise = endpoint(0);
  const Octets record = Forged{}.holding(encoded(fire(1)));
  for (int i = 0; i < 5; ++i) to_host(record);
  EXPECT_EQ(shots_[1].size(), 1U);
  EXPECT_EQ(count(1, "assured_doubled_in"), 4U);
}

TEST_F(AssuredForgery, FarSequencesDoNotStopGenuineOnes) {
  federates_[0]->send(fire(1), Delivery::assured);
  run(100ms);
  links_[1]->disguise = endpoint(0);
  for (const std::uint32_t far : {258U, 100'000U, 0x80000000U, 0xFFFFFF00U})
    to_host(Forged{.sequence = far}.holding(encoded(fire(9))));
  federates_[0]->send(fire(2), Delivery::assured);
  run(100ms);
  EXPECT_EQ(shots_[1], (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(count(1, "assured_refused"), 4U);
}

TEST_F(AssuredForgery, AcknowledgementsOfOthersEndNothing) {
  std::vector<peer::UndeliveredMessage> lost;
  federates_[0]->on_undelivered(
      [&](const peer::UndeliveredMessage& message) { lost.push_back(message); });
  network_.impair(0, 1, Federates::delayed(0ms, 1.0));
  federates_[0]->send(fire(1), Delivery::assured);
  run(10ms);
  const Octets all(64, std::byte{0xFF});
  Forged receipt{1, kEpoch1, kEpoch0, pdu::AssuredKind::acknowledgement};
  to_group(receipt.holding(all));
  pdu::DatagramTrailer trailer;
  trailer.header.exercise_id = 1;
  trailer.epoch = kEpoch1;
  to_group(joined(receipt.holding(all), encoded(trailer)));
  ASSERT_TRUE(attacker_.send(endpoint(0), receipt.holding(all)));
  run(20ms);
  EXPECT_EQ(count(0, "unicast_refused"), 1U);
  EXPECT_GE(count(0, "assured_refused"), 1U);
  run(5s);
  ASSERT_EQ(lost.size(), 1U) << "the forged acknowledgements were not believed";
  EXPECT_EQ(lost[0].peers.at(0).cause, peer::UndeliveredCause::gave_up);
}

TEST_F(AssuredForgery, NestedControlPdusAreRefused) {
  links_[1]->disguise = endpoint(0);
  const Octets inner = Forged{.sequence = 7}.holding(encoded(fire(1)));
  pdu::EntityState state;
  state.header.exercise_id = 1;
  state.entity_id = {1, 1, 5};
  to_host(Forged{.sequence = 1}.holding(inner));
  to_host(Forged{.sequence = 2}.holding(encoded(state)));
  to_host(Forged{.sequence = 3}.holding(joined(encoded(fire(2)), encoded(fire(3)))));
  to_host(Forged{.sequence = 4}.holding({}));
  to_host(Forged{.sequence = 5, .kind = pdu::AssuredKind{77}}.holding(encoded(fire(4))));
  EXPECT_TRUE(shots_[1].empty());
  EXPECT_EQ(federates_[1]->size(), 0U);
  EXPECT_EQ(count(1, "assured_unknown"), 1U);
}

TEST_F(AssuredForgery, UnicastDeliversWhereGroupsLoseRecords) {
  bool undelivered = false;
  federates_[0]->on_undelivered([&](const peer::UndeliveredMessage&) { undelivered = true; });
  for (const auto& link : links_) link->loses_records = true;
  federates_[0]->send(fire(1), Delivery::assured);
  run(380ms);
  EXPECT_TRUE(shots_[1].empty());
  run(30ms);
  EXPECT_EQ(shots_[1].size(), 1U) << "392 ms";
  run(6s);
  EXPECT_EQ(shots_[1].size(), 1U);
  EXPECT_FALSE(undelivered) << "the acknowledgement came by unicast, too";
}

}  // namespace
}  // namespace reckon::test

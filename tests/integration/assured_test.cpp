// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Assured interactions of federates over a simulated network.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/management/comment.hpp"
#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/tests/integration/federates.hpp"

namespace reckon::test {
namespace {

using namespace std::chrono_literals;
using peer::Delivery;
using peer::Federate;
using peer::UndeliveredCause;
using std::chrono::nanoseconds;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

pdu::Fire shot(std::uint32_t number, const pdu::EntityId& by = {1, 1, 900}) {
  pdu::Fire fire;
  fire.firing_entity_id = by;
  fire.fire_mission_index = number;
  return fire;
}

// Federates that count the shots of each number that they receive.
class Gunners {
 public:
  Gunners(std::size_t count, double loss, std::uint64_t seed = 1,
          const peer::SceneFile& scene = open_country())
      : world_(count + 1, test::Federates::delayed(200us, loss, 300us), seed), received_(count) {
    for (std::size_t i = 0; i < count; ++i) {
      Federate& federate = world_.join(scene);
      federate.publish<pdu::Fire>();
      federate.subscribe<pdu::Fire>(
          [this, i](const pdu::Fire& fire) { ++received_[i][fire.fire_mission_index]; });
    }
    world_[0].on_undelivered([this](const peer::UndeliveredMessage& lost) {
      EXPECT_EQ(lost.type, pdu::PduType::fire);
      for (const peer::MissedPeer& missed : lost.peers)
        undelivered_[lost.message.number].emplace_back(missed.peer.application, missed.cause);
    });
    run(2s);
  }

  void run(nanoseconds span) {
    world_.run(
        span, 500us, [] {}, [this] { look(); });
  }
  // Listens at the network as a host of its own.
  void listen() {
    const peer::GroupPool pool = peer::pool_of(open_country());
    static_cast<void>(ear().join(pool.base()));
    for (std::size_t i = 0; i < pool.size(); ++i) static_cast<void>(ear().join(pool.address(i)));
  }
  peer::Link& ear() { return world_.link(received_.size()); }

  test::Federates world_;
  std::vector<std::map<std::uint32_t, int>> received_;
  std::map<std::uint64_t, std::vector<std::pair<std::uint16_t, UndeliveredCause>>> undelivered_;
  std::vector<std::vector<pdu::PduType>> heard_;  // types of each datagram

 private:
  void look() {
    std::array<peer::Datagram, 16> batch;
    for (std::size_t count; (count = ear().receive(batch)) > 0;) {
      for (const peer::Datagram& datagram : std::span(batch).first(count)) {
        heard_.emplace_back();
        for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram.bytes))
          heard_.back().push_back(pdu.header.pdu_type);
      }
    }
  }
};

class AssuredAtLoss : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Percent, AssuredAtLoss, testing::Values(0.0, 0.2, 0.3));

TEST_P(AssuredAtLoss, EachPeerGetsEachShotOnce) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Gunners gunners(4, GetParam(), seed);
    constexpr std::uint32_t kShots = 300;
    for (std::uint32_t i = 0; i < kShots; ++i) {
      gunners.world_[0].send(shot(i), Delivery::assured);
      if (i % 3 == 0) gunners.world_[1].send(shot(1000 + i, {1, 2, 900}), Delivery::assured);
      gunners.run(i % 5 == 0 ? 7ms : 2ms);
    }
    gunners.run(3s);
    for (std::size_t peer = 1; peer < 4; ++peer) {
      const std::size_t others = peer == 1 ? 0 : kShots / 3;
      EXPECT_THAT(gunners.received_[peer], SizeIs(kShots + others)) << "seed " << seed;
      EXPECT_THAT(gunners.received_[peer], Each(Pair(testing::_, 1))) << "seed " << seed;
    }
    EXPECT_THAT(gunners.received_[0], SizeIs(kShots / 3));
    EXPECT_THAT(gunners.undelivered_, IsEmpty());
    EXPECT_EQ(gunners.world_.count(0, "assured_out"), kShots);
    EXPECT_EQ(gunners.world_.count(0, "assured_repeats") > 0, GetParam() > 0);
  }
}

TEST(Assured, FirstTransmissionIsPlainAndMarked) {
  Gunners gunners(2, 0.0);
  gunners.listen();
  pdu::Fire near = shot(1);
  const Eigen::Vector3d& origin = gunners.world_[0].frame().origin();
  near.location_in_world_coordinates = {origin.x(), origin.y(), origin.z()};
  gunners.world_[0].send(near);
  gunners.run(2s);
  std::size_t plain = 0;
  for (const auto& datagram : gunners.heard_) {
    plain += static_cast<std::size_t>(std::ranges::count(datagram, pdu::PduType::fire));
    EXPECT_EQ(std::ranges::count(datagram, pdu::PduType::assured_record), 0)
        << "no program has asked";
  }
  EXPECT_EQ(plain, 1U);
  gunners.heard_.clear();
  gunners.world_[0].send(shot(2), Delivery::assured);
  gunners.run(50ms);
  std::vector<std::vector<pdu::PduType>> records;
  for (const auto& datagram : gunners.heard_) {
    if (std::ranges::count(datagram, pdu::PduType::assured_record) > 0) records.push_back(datagram);
  }
  EXPECT_THAT(records, ElementsAre(ElementsAre(pdu::PduType::fire, pdu::PduType::assured_record,
                                               pdu::PduType::datagram_trailer),
                                   ElementsAre(pdu::PduType::assured_record,
                                               pdu::PduType::datagram_trailer)))
      << "the shot and its acknowledgement";
  EXPECT_THAT(gunners.received_[1], ElementsAre(Pair(1, 1), Pair(2, 1)));
}

TEST(Assured, PeerThatLeavesIsReported) {
  Gunners gunners(3, 0.0);
  gunners.world_.impair(0, 2, test::Federates::delayed(0ms, 1.0));
  const peer::MessageHandle lost = gunners.world_[0].send(shot(1), Delivery::assured);
  gunners.run(500ms);
  EXPECT_THAT(gunners.undelivered_, IsEmpty());
  gunners.world_[2].resign();
  gunners.run(500ms);
  EXPECT_THAT(gunners.undelivered_,
              ElementsAre(Pair(lost.number, ElementsAre(Pair(3, UndeliveredCause::left)))));
  EXPECT_EQ(gunners.received_[1][1], 1);
  EXPECT_EQ(gunners.world_.count(0, "assured_undelivered"), 1U);
}

TEST(Assured, DeafPeerIsGivenUpAfterFiveSeconds) {
  Gunners gunners(3, 0.0);
  gunners.world_.impair(0, 2, test::Federates::delayed(0ms, 1.0));
  const peer::MessageHandle lost = gunners.world_[0].send(shot(1), Delivery::assured);
  gunners.run(4990ms);
  EXPECT_THAT(gunners.undelivered_, IsEmpty());
  gunners.run(20ms);
  EXPECT_THAT(gunners.undelivered_,
              ElementsAre(Pair(lost.number, ElementsAre(Pair(3, UndeliveredCause::gave_up)))));
  bool noticed = false;
  for (peer::Notice notice; gunners.world_[0].peer().notices().pop(notice);)
    noticed = noticed || notice.kind == peer::NoticeKind::undelivered;
  EXPECT_TRUE(noticed);
}

TEST(Assured, MoreThanAWindowInFlightIsRefused) {
  Gunners gunners(2, 0.0);
  gunners.world_.impair(0, 1, test::Federates::delayed(0ms, 1.0));
  for (std::uint32_t i = 0; i < 260; ++i) gunners.world_[0].send(shot(i), Delivery::assured);
  gunners.run(10ms);
  EXPECT_THAT(gunners.undelivered_, SizeIs(4));
  EXPECT_THAT(gunners.undelivered_,
              Each(Pair(testing::Gt(256U), ElementsAre(Pair(2, UndeliveredCause::in_flight)))));
}

TEST(Assured, ShotOfAnothersEntityIsReportedAsRefused) {
  Gunners gunners(2, 0.0);
  peer::EntityDescription truck;
  truck.marking = "TRUCK";
  truck.type = {pdu::EntityKind::platform, pdu::EntityDomain::land};
  gunners.world_[1].register_object(truck, {});
  gunners.run(1s);
  const pdu::EntityId id = gunners.world_.id_of(1);
  const peer::MessageHandle forged = gunners.world_[0].send(shot(1, id), Delivery::assured);
  gunners.run(100ms);
  EXPECT_THAT(gunners.undelivered_,
              ElementsAre(Pair(forged.number, ElementsAre(Pair(2, UndeliveredCause::refused)))));
  EXPECT_THAT(gunners.received_[1], IsEmpty());
  EXPECT_EQ(gunners.world_.count(1, "interactions_refused"), 1U);
}

TEST(Assured, RestartedPeerGetsOnlyNewShots) {
  Gunners gunners(2, 0.1);
  for (std::uint32_t i = 0; i < 20; ++i) gunners.world_[0].send(shot(i), Delivery::assured);
  gunners.run(1s);
  gunners.world_.restart(1, open_country(), 77);
  gunners.received_[1].clear();
  gunners.world_[1].subscribe<pdu::Fire>(
      [&](const pdu::Fire& fire) { ++gunners.received_[1][fire.fire_mission_index]; });
  gunners.run(2s);
  for (std::uint32_t i = 20; i < 40; ++i) gunners.world_[0].send(shot(i), Delivery::assured);
  gunners.run(1s);
  EXPECT_THAT(gunners.received_[1], SizeIs(20));
  EXPECT_THAT(gunners.received_[1],
              Each(AllOf(testing::Key(testing::Ge(20U)), Pair(testing::_, 1))));
  EXPECT_THAT(gunners.undelivered_, IsEmpty());
}

struct Ledger final : peer::AssuredUser {
  bool take_record(const peer::UserRecord& record) noexcept override {
    taken.push_back(record.octets.size());
    return record.octets.size() % 2 == 0;
  }
  void settle(const peer::AssuredReport& report) noexcept override { reports.push_back(report); }
  std::vector<std::size_t> taken;
  std::vector<peer::AssuredReport> reports;
};

TEST(Assured, UsersExchangeRecordsWithVerdicts) {
  Gunners gunners(3, 0.2);
  std::array<Ledger, 2> ledgers;
  for (std::size_t i = 0; i < 2; ++i)
    gunners.world_[i].peer().model().assured().set_user(&ledgers[i]);
  const std::vector<std::byte> octets(1200);
  const std::vector<std::uint32_t> second{2}, second_and_third{2, 3};
  std::vector<std::size_t> sent;
  const auto send = [&](const std::vector<std::uint32_t>& to) {
    peer::ModelLoop& model = gunners.world_[0].peer().model();
    sent.push_back(1 + sent.size() % 1200);
    const std::span<const std::byte> content = std::span(octets).first(sent.back());
    return model.assured().send({pdu::AssuredKind{16}, 0, content, 5}, to, model.pass());
  };
  gunners.world_[0].send(shot(0), Delivery::assured);
  gunners.run(1s);
  for (int i = 0; i < 600; ++i) {
    EXPECT_TRUE(send(second));
    gunners.run(2ms);
  }
  gunners.run(2s);
  std::ranges::sort(ledgers[1].taken);
  EXPECT_EQ(ledgers[1].taken, sent);
  ASSERT_EQ(ledgers[0].reports.size(), 600U);
  for (const peer::AssuredReport& report : ledgers[0].reports) {
    const bool refuses = sent[report.sequence - 2] % 2 != 0;
    EXPECT_EQ(report.outcome,
              refuses ? peer::AssuredOutcome::refused : peer::AssuredOutcome::accepted);
  }
  EXPECT_GE(gunners.world_.count(2, "assured_unknown"), 600U) << "it has no user";
  gunners.world_[0].send(shot(1), Delivery::assured);
  gunners.run(500ms);
  EXPECT_EQ(gunners.received_[2][1], 1) << "the window followed the records for others";
  EXPECT_TRUE(send(second_and_third));
  gunners.run(6s);
  EXPECT_EQ(ledgers[0].reports.back().outcome, peer::AssuredOutcome::gave_up);
  EXPECT_EQ(ledgers[0].reports.back().peer, 3U);
}

// Over UDP with threads; at this loss some records need the way to a single host.
TEST(AssuredOnLo, LossyPeersGetEachShotOnce) {
  peer::FederateOptions options;
  options.scene = open_country();
  options.scene->network.exercise = 78;
  options.scene->impairment.law.loss = 0.6;
  options.interface = "lo";
  options.loops = peer::FederateLoops::threads;
  Federate one(options);
  options.application = 2;
  options.receiver = 1;
  Federate two(options);
  std::map<std::uint32_t, int> received;
  two.subscribe<pdu::Fire>([&](const pdu::Fire& fire) { ++received[fire.fire_mission_index]; });
  std::size_t undelivered = 0;
  one.on_undelivered([&](const peer::UndeliveredMessage&) { ++undelivered; });
  one.publish<pdu::Fire>();
  const auto until = [&](auto&& holds) {
    for (int i = 0; i < 1000 && !holds(); ++i) {
      std::this_thread::sleep_for(10ms);
      one.step();
      two.step();
    }
    return holds();
  };
  const auto peers = [](Federate& federate) {
    federate.peer().views().update();
    return federate.peer().views().read().peers;
  };
  ASSERT_TRUE(until([&] { return peers(one) == 1 && peers(two) == 1; }));
  constexpr std::uint32_t kShots = 100;
  for (std::uint32_t i = 0; i < kShots; ++i) one.send(shot(i), Delivery::assured);
  EXPECT_TRUE(until([&] { return received.size() == kShots; }));
  EXPECT_THAT(received, Each(Pair(testing::_, 1)));
  EXPECT_EQ(undelivered, 0U);
  const peer::Counter* refused = two.peer().counters().find("unicast_refused");
  EXPECT_EQ(refused->value(), 0U);
}

TEST(Assured, ImpossibleRequestIsRefusedWithTheRemedy) {
  const auto why = [](const auto& ask) -> std::string {
    try {
      ask();
    } catch (const std::logic_error& error) {
      return error.what();
    }
    return "";
  };
  test::Federates plain(1, {});
  plain.join(*peer::dis_exercise(1)).publish<pdu::Fire>();
  EXPECT_THAT(why([&] { plain[0].send(shot(1), Delivery::assured); }),
              testing::HasSubstr("Delivery::best_effort"));
  test::Federates peers(1, {});
  Federate& federate = peers.join(open_country());
  federate.publish<pdu::EntityState>();
  federate.publish<pdu::Comment>();
  EXPECT_THAT(why([&] { federate.send(pdu::EntityState{}, Delivery::assured); }),
              testing::HasSubstr("PDU type 1 cannot be assured"));
  const std::vector<std::byte> octets(1200);
  pdu::Comment comment;
  comment.fixed_datums = octets;
  EXPECT_THAT(why([&] { federate.send(comment, Delivery::assured); }),
              testing::HasSubstr("1200 at most"));
  EXPECT_EQ(federate.send(pdu::Comment{}).number, 0U);
}

}  // namespace
}  // namespace reckon::test

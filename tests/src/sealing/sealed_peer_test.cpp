// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whole peers with a key and without.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/loops/life_proof.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::peer {
namespace {

using namespace samples;
using Said = std::vector<std::pair<IpEndpoint, Octets>>;

// Stores all sent datagrams, and can replace the sender address of received ones.
class RecordingLink final : public Link {
 public:
  explicit RecordingLink(Link& inner) : inner_(inner) {}
  bool send(const IpEndpoint& to, std::span<const std::byte> bytes) noexcept override {
    said.emplace_back(to, Octets(bytes.begin(), bytes.end()));
    if (loses_groups && to.is_multicast()) return true;
    return inner_.send(to, bytes);
  }
  std::size_t receive(std::span<Datagram> out) noexcept override {
    const std::size_t count = inner_.receive(out);
    if (others_at)
      for (Datagram& datagram : out.first(count)) datagram.sender = *others_at;
    return count;
  }
  std::error_code join(const GroupAddress& group) noexcept override { return inner_.join(group); }
  void leave(const GroupAddress& group) noexcept override { inner_.leave(group); }
  bool wait(nanoseconds timeout) noexcept override { return inner_.wait(timeout); }
  void wake() noexcept override { inner_.wake(); }
  IpEndpoint local_endpoint() const noexcept override { return inner_.local_endpoint(); }
  std::size_t max_payload() const noexcept override { return inner_.max_payload(); }
  LinkStatistics statistics() const noexcept override { return inner_.statistics(); }

  Said said;
  bool loses_groups = false;
  std::optional<IpEndpoint> others_at;

 private:
  Link& inner_;
};

SceneFile scene_of(std::size_t peers) {
  SceneFile scene;
  scene.hash = scene_hash(scene);
  for (std::uint32_t i = 1; i <= peers; ++i) {
    EntityConfig& entity = scene.entities.emplace_back();
    entity.peer = i;
    entity.marking = "POST";
    entity.position = {0.01 * i, 0, 0};
  }
  return scene;
}

FederateOptions options_of(const SceneFile& scene, std::uint32_t number) {
  FederateOptions options;
  options.scene = scene;
  options.scene_peer = number;
  options.application = static_cast<std::uint16_t>(number);
  return options;
}

// Some peers of one process in simulated time; datagrams take 10 ms.
struct Peers {
  Peers(std::size_t count, const SceneFile& scene) : hub({.links = count}, clock) {
    ImpairmentLaw law;
    law.delay = 10ms;
    hub.impair(law);
    for (std::uint32_t i = 0; i < count; ++i) {
      links.push_back(std::make_unique<RecordingLink>(hub.link(i)));
      joined.push_back(
          std::make_unique<JoinedPeer>(options_of(scene, i + 1), *links[i], clock, i + 1));
    }
  }
  void run(nanoseconds span) {
    for (nanoseconds passed{0}; passed < span; passed += 1ms) {
      for (auto& peer : joined) peer->pass();
      clock.advance(1ms);
    }
  }
  // The latest time at which a peer first received a remote entity; runs 3 s.
  nanoseconds seen() {
    const auto first = [](JoinedPeer& peer) {
      peer.peer().views().update();
      return peer.peer().views().read().first_remote;
    };
    run(3s);
    nanoseconds latest{0};
    for (auto& peer : joined) {
      const nanoseconds at = first(*peer);
      latest = at < nanoseconds(0) ? nanoseconds::max() : std::max(latest, at);
    }
    return latest;
  }

  ManualClock clock{1s, 1h};
  SimulatedNetwork hub;
  std::vector<std::unique_ptr<RecordingLink>> links;
  std::vector<std::unique_ptr<JoinedPeer>> joined;
};

class SealedPeer : public testing::Test {
 protected:
  SceneFile keyed(std::size_t peers) const {
    const std::string path = folder_.file("g.key");
    save_group_key(group_key(), path, false);
    SceneFile scene = scene_of(peers);
    scene.network.key = path;
    return scene;
  }
  test::ScratchFolder folder_;
};

TEST_F(SealedPeer, AssuredMessageIsSealedForItsHost) {
  Peers peers(2, keyed(2));
  peers.run(3s);
  Peer& sender = peers.joined[0]->peer();
  const auto count = [&](const char* name) {
    return peers.joined[1]->peer().counters().find(name)->value();
  };
  for (const auto& link : peers.links) link->said.clear(), link->loses_groups = true;
  pdu::Fire fire;
  fire.header.exercise_id = 1;
  Octets octets(pdu::wire_size(fire));
  ASSERT_EQ(pdu::encode(fire, octets), octets.size());
  sender.model().assured().send(octets, 7, 0, sender.model().pass());
  peers.run(500ms);
  EXPECT_EQ(count("assured_in"), 1U) << "by unicast after 392 ms";
  peers.run(1s);
  EXPECT_EQ(sender.counters().find("assured_undelivered")->value(), 0U);
  EXPECT_EQ(sender.model().assured().next_step(), nanoseconds::max()) << "acknowledged";

  const Said said = peers.links[0]->said;
  const IpEndpoint host = peers.hub.link(1).local_endpoint();
  const std::uint64_t replayed = count("sealed_replayed_in"), forged = count("sealed_forged_in");
  std::size_t to_host = 0, to_group = 0;
  for (const auto& [to, datagram] : said) {
    ++(to == host ? to_host : to_group);
    peers.hub.link(0).send(host, datagram);
  }
  peers.run(50ms);
  EXPECT_GT(to_host, 0U);
  EXPECT_EQ(count("sealed_replayed_in"), replayed + to_host);
  EXPECT_EQ(count("sealed_forged_in"), forged + to_group) << "sealed for a group";
  EXPECT_EQ(count("unicast_refused"), 0U);
}

// Without a key a joined peer sends the same octets as a peer constructed directly on the bare
// link.
TEST_F(SealedPeer, SendsUnsealedOctetsWithoutAKey) {
  const SceneFile scene = scene_of(1);
  Peers joined(1, scene);
  joined.run(12s);

  ManualClock clock{1s, 1h};
  SimulatedNetwork hub({.links = 1}, clock);
  RecordingLink link(hub.link(0));
  const FederateOptions options = options_of(scene, 1);
  PeerOptions own;
  own.name = options.name;
  own.application = options.application.value_or(own.application);
  own.scene_peer = static_cast<std::uint8_t>(options.scene_peer);
  own.epoch = 1;
  own.chain_secret = chain_secret_of(own.epoch);
  own.started = static_cast<std::uint32_t>(clock.utc_now() / 1s);
  own.entities = entities_of(scene, 1);
  Peer bare(scene, own, link, {});
  bare.start(clock.now());
  for (int i = 0; i < 12000; ++i) {
    bare.read_step(clock.now());
    bare.model_step(clock.now(), clock.utc_now());
    bare.write_step();
    clock.advance(1ms);
  }
  ASSERT_GT(link.said.size(), 10U);
  EXPECT_EQ(joined.links[0]->said, link.said);
  EXPECT_EQ(joined.joined[0]->peer().counters().find("sealed_in"), nullptr);
}

TEST_F(SealedPeer, SendsNothingUnsealedAndIsReceived) {
  const SceneFile scene = keyed(2);
  Peers peers(2, scene);
  EXPECT_LT(peers.seen(), 3s);
  for (const auto& link : peers.links) {
    ASSERT_FALSE(link->said.empty());
    for (const auto& [to, octets] : link->said) {
      EXPECT_TRUE(read_envelope(octets));
      EXPECT_EQ(to.port, scene.network.group.port + 1);
    }
  }
}

TEST_F(SealedPeer, ReportsASealedExerciseWithoutTheKey) {
  ManualClock clock{1s, 1h};
  SimulatedNetwork hub({.links = 2}, clock);
  JoinedPeer peer(options_of(scene_of(1), 1), hub.link(0), clock, 1);
  EnvelopeSealer sealer(group_key(), 1, 1);
  std::string told;
  for (int i = 0; i < 2000; ++i) {
    hub.link(1).send(SceneFile().network.group, sealed(sealer, Octets(100)));
    peer.pass();
    clock.advance(1ms);
    for (; peer.peer().notices().front() != nullptr; peer.peer().notices().pop())
      told += peer.peer().notices().front()->text.data();
  }
  EXPECT_THAT(told, testing::HasSubstr("set [network] key"));
  EXPECT_GT(peer.peer().counters().find("sealed_unread_in")->value(), 1000U);
  EXPECT_EQ(peer.peer().counters().find("malformed_in")->value(), 0U);
}

// One round trip is 20 ms here.
TEST_F(SealedPeer, JoinsOneRoundTripAnd50MsLater) {
  const std::size_t count = test::tries<std::size_t>(32, 64);
  Peers plain(count, scene_of(count));
  Peers sealed(count, keyed(count));
  const nanoseconds without = plain.seen(), with = sealed.seen();
  EXPECT_LE(with, without + 20ms + 50ms);
  RecordProperty("plain_ms", static_cast<int>(without / 1ms));
  RecordProperty("sealed_ms", static_cast<int>(with / 1ms));
}

// Counts the datagrams that the second of two peers refuses in the two seconds after the first has
// changed its address.
std::uint64_t refused_after_a_move(const SceneFile& scene) {
  Peers peers(2, scene);
  peers.run(3s);
  const Counter& refused = *peers.joined[1]->peer().counters().find("datagrams_refused");
  const std::uint64_t before = refused.value();
  peers.links[1]->others_at = *IpEndpoint::parse("10.9.8.7:4321");
  peers.run(2s);
  return refused.value() - before;
}

TEST_F(SealedPeer, IsBelievedAtOnceWhereItsAddressChanges) {
  EXPECT_EQ(refused_after_a_move(keyed(2)), 0U);
  EXPECT_GT(refused_after_a_move(scene_of(2)), 0U) << "without a key an address is who it is";
}

TEST_F(SealedPeer, IsNotBegunWhereInteropWantsPlainDis) {
  SceneFile scene = keyed(1);
  scene.network.interop = true;
  EXPECT_THROW(Peers(1, scene), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::peer

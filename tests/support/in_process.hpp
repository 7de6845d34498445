// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Peers in one thread over a simulated network, one millisecond a step, with a listener on the same
// network that a test controls.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/pdu/bundle.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::test {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

/// A silent peer is removed after six missed announcements, one each second, and 100 ms of slack.
inline constexpr milliseconds kPresenceTimeout{6100};
/// Period of the peers' snapshots.
inline constexpr milliseconds kPicture{50};

/// Two hands on a wall: the first moves back and forth along it; the second is in its way and is
/// pushed.
inline constexpr std::string_view kTwoHandsOnAWall = R"(
[scene]
name = "two hands on a wall"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[[object]]
name = "wall"
plane = [0.0, 0.0, 1.0]
surface = {stiffness = "800 N/m", damping = "0.2 N s/m"}
friction = {static = 0.5, kinetic = 0.35}

[hand]
radius = "10 mm"
k1 = "300 N/m"

[aoim]
pool = 16

[[operator]]
sweep = {from = [-0.06, 0.0, 0.002], to = [0.005, 0.0, -0.002], period = "2 s"}

[[operator]]
passive = true
position = [0.015, 0.0, 0.001]
stiffness = "150 N/m"
)";

inline peer::SceneFile scene_of(std::string_view text) {
  return peer::parse_scene_file(text, "test scene");
}

/// The scene, in which the named peers may stop and start it, as in `allow_management`.
inline peer::SceneFile managed_by(std::string_view whom, peer::SceneFile scene) {
  scene.network.management = peer::ManagementRule::parse(whom).value();
  return scene;
}

/// The shipped scene, with its mesh and recorded hands.
inline peer::SceneFile shipped_scene() {
  return peer::load_scene_file(test::source_dir() + "/scenes/two_hands.toml");
}

/// `text` with the only occurrence of `old` replaced.
inline std::string with(std::string_view text, std::string_view old, std::string_view replacement) {
  std::string result(text);
  const std::size_t at = result.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  if (at != std::string::npos) result.replace(at, old.size(), replacement);
  return result;
}

/// A datagram that the listener received.
struct Heard {
  nanoseconds time;
  peer::GroupAddress group;
  peer::IpEndpoint sender;
  std::vector<std::byte> octets;
};

/// Peers 0 .. N-1 on links 0 .. N-1, and a listener on link N that has joined every group.
class InProcess {
 public:
  /// @param in_flight datagrams that each link holds
  explicit InProcess(std::size_t links, std::uint64_t seed = 1,
                     std::size_t in_flight = peer::SimulatedNetworkOptions{}.datagrams_in_flight)
      : clock_(seconds(1), std::chrono::hours(1)),
        network_(options(links, seed, in_flight), clock_),
        places_(links) {}

  /// Starts a peer on a link, from now on. @param scene must outlive it.
  peer::Peer& start(std::size_t link, const peer::SceneFile& scene, std::uint32_t epoch,
                    std::uint16_t application) {
    peer::PeerOptions own;
    own.name = "HAND" + std::to_string(link + 1);
    own.application = application;
    own.epoch = epoch;
    Place& place = places_[link];
    place.scene = &scene;
    const auto number = static_cast<std::uint32_t>(link + 1);
    place.hands = tools::make_simulated_hands(scene, number, place.script);
    own.entities = peer::entities_of(scene, number);
    own.record_changes = true;
    place.peer = std::make_unique<peer::Peer>(scene, own, network_.link(link), place.hands.wired);
    place.peer->start(clock_.now());
    return *place.peer;
  }
  peer::Peer& start(std::size_t link, const peer::SceneFile& scene) {
    return start(link, scene, static_cast<std::uint32_t>(100 + link),
                 static_cast<std::uint16_t>(1 + link));
  }

  /// From its start on `script` moves the hands of a link, instead of its operator.
  void move_by(std::size_t link, const haptics::HandScript& script) {
    places_[link].script = script;
  }
  /// Sets the clock of a link's host: `ahead` of UTC now, gaining `drift` [s/s] from now on.
  void set_host_clock(std::size_t link, nanoseconds ahead, double drift = 0.0) {
    places_[link].ahead = ahead;
    places_[link].drift = drift;
    places_[link].set_at = clock_.now();
  }
  /// UTC by the clock of a link's host.
  [[nodiscard]] nanoseconds host_utc(std::size_t link) const {
    const Place& place = places_[link];
    const auto gained = place.drift * static_cast<double>((clock_.now() - place.set_at).count());
    return clock_.utc_now() + place.ahead + nanoseconds(std::llround(gained));
  }

  /// A clean end: leave announcement, then silence.
  void stop(std::size_t link) {
    places_[link].peer->stop(clock_.now(), host_utc(link));
    kill(link);
  }
  /// kill -9: no leave announcement. Its sockets are closed: all memberships are left and queued
  /// datagrams are lost.
  void kill(std::size_t link) {
    const peer::SceneFile& scene = *places_[link].scene;
    places_[link].peer.reset();
    peer::Link& port = network_.link(link);
    const peer::GroupPool pool = peer::pool_of(scene);
    port.leave(pool.base());
    for (std::size_t i = 0; i < pool.size(); ++i) port.leave(pool.address(i));
    std::array<peer::Datagram, 16> batch;
    while (port.receive(batch) > 0) {
    }
  }

  /// Joins all groups from now on.
  void listen(const peer::SceneFile& scene) {
    const peer::GroupPool pool = peer::pool_of(scene);
    static_cast<void>(ear().join(pool.base()));
    for (std::size_t i = 0; i < pool.size(); ++i) static_cast<void>(ear().join(pool.address(i)));
  }
  /// Sends a message to the base group.
  template <pdu::Pdu T>
  void say(const T& message, const peer::SceneFile& scene) {
    std::vector<std::byte> octets(pdu::wire_size(message));
    ASSERT_EQ(pdu::encode(message, octets), octets.size());
    ASSERT_TRUE(ear().send(scene.network.group, octets));
  }
  [[nodiscard]] std::vector<Heard>& heard() { return heard_; }
  /// All PDUs of one type that the listener received.
  template <pdu::Pdu T>
  [[nodiscard]] std::vector<T> heard_pdus() const {
    std::vector<T> result;
    for (const Heard& datagram : heard_) {
      for (const pdu::BundledPdu& pdu : pdu::BundleReader(datagram.octets)) {
        T message;
        if (pdu.header.pdu_type == T::kPduType &&
            pdu::decode(pdu.bytes, message) == pdu::DecodeError::none) {
          result.push_back(message);
        }
      }
    }
    return result;
  }

  /// Runs this many milliseconds.
  void run(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) step();
  }
  /// Runs at most `limit` milliseconds, until the condition holds; returns how many, or limit + 1.
  template <typename Condition>
  [[nodiscard]] std::size_t run_until(Condition&& holds, std::size_t limit) {
    for (std::size_t i = 0; i <= limit; ++i) {
      if (holds()) return i;
      step();
    }
    return limit + 1;
  }

  [[nodiscard]] peer::Peer& peer(std::size_t link) { return *places_[link].peer; }
  /// Newest snapshot of a peer; peers make one every 50 ms.
  [[nodiscard]] const peer::PeerView& view(std::size_t link) {
    peer(link).views().update();
    return peer(link).views().read();
  }
  [[nodiscard]] std::uint64_t count(std::size_t link, std::string_view counter) {
    const peer::Counter* found = peer(link).counters().find(counter);
    EXPECT_NE(found, nullptr) << counter;
    return found == nullptr ? 0 : found->value();
  }
  /// Notices since the last call.
  [[nodiscard]] std::vector<std::string> notices(std::size_t link) {
    std::vector<std::string> result;
    auto& ring = peer(link).notices();
    while (const peer::Notice* notice = ring.front()) {
      result.emplace_back(notice->text.data());
      ring.pop();
    }
    return result;
  }

  [[nodiscard]] peer::ManualClock& clock() { return clock_; }
  [[nodiscard]] peer::SimulatedNetwork& network() { return network_; }
  [[nodiscard]] std::uint64_t steps() const { return step_; }

 private:
  struct Place {
    const peer::SceneFile* scene = nullptr;
    haptics::HandScript script;
    tools::SimulatedHands hands;
    std::unique_ptr<peer::Peer> peer;
    nanoseconds ahead{0};  // offset of its host's clock when it was set
    double drift = 0.0;
    nanoseconds set_at{0};
  };

  static peer::SimulatedNetworkOptions options(std::size_t links, std::uint64_t seed,
                                               std::size_t in_flight) {
    peer::SimulatedNetworkOptions result;
    result.links = links + 1;
    result.seed = seed;
    result.datagrams_in_flight = in_flight;
    return result;
  }
  peer::Link& ear() { return network_.link(places_.size()); }

  void step() {
    clock_.advance(milliseconds(1));
    ++step_;
    const nanoseconds now = clock_.now();
    for (Place& place : places_) {
      if (place.peer) place.peer->servo_step(now);
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
      Place& place = places_[i];
      if (!place.peer) continue;
      place.peer->read_step(now);
      if (step_ % 2 == 0) place.peer->model_step(now, host_utc(i));
      place.peer->write_step();
    }
    std::array<peer::Datagram, 16> batch;
    for (std::size_t n = ear().receive(batch); n > 0; n = ear().receive(batch)) {
      for (std::size_t i = 0; i < n; ++i) {
        heard_.push_back(
            {now, batch[i].group, batch[i].sender, {batch[i].bytes.begin(), batch[i].bytes.end()}});
      }
    }
  }

  peer::ManualClock clock_;
  peer::SimulatedNetwork network_;
  std::vector<Place> places_;
  std::vector<Heard> heard_;
  std::uint64_t step_ = 0;
};

}  // namespace reckon::test
